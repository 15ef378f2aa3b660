#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

namespace {

bool given(const Scene& scene, const std::string& key) {
  return scene.knows(key) && scene.has(key);
}

template <int dim>
std::vector<std::string> names_of(const CounterShapeKind<dim>& kind) {
  std::vector<std::string> names;
  for (const Key& key : kind.keys) names.push_back(key.name);
  return names;
}

/// What a table for the plane and for space lets pass.
template <int dim>
void check_dimension(const Scene& scene) {
  const std::vector<Key> own = counter_body_keys<dim>();
  const char* const here = dim == 2 ? "in the plane" : "in space";
  for (const Key& key : counter_body_keys()) {
    if (!given(scene, key.name)) continue;
    const auto there = std::find_if(own.begin(), own.end(),
                                    [&](const Key& other) { return other.name == key.name; });
    if (there == own.end())
      throw InputError(fmt::format("{}: there is no such key {}", scene.where(key.name), here));
    if (there->length != 0 && scene.reals(key.name).size() != there->length)
      throw InputError(fmt::format("{}: expected {} numbers {}, got {}", scene.where(key.name),
                                   there->length, here, scene.reals(key.name).size()));
  }
}

/// The scene with the defaults of the shape. Throws where a key of it is missing, or one is given
/// that only other shapes have.
template <int dim>
Scene of_shape(Scene scene, const CounterShapeKind<dim>& kind) {
  for (const Key& key : kind.keys) {
    if (scene.has(key.name) || key.presence == Key::Presence::optional) continue;
    if (key.presence == Key::Presence::required)
      throw InputError(fmt::format("{}: expected also {}, {}", scene.where("counter_body.shape"),
                                   key.name, key.help));
    scene = scene.with(key.name, key.default_value);
  }
  const std::vector<std::string> own = names_of(kind);
  for (const auto& other : Registry<CounterShapeKind<dim>>::all())
    for (const Key& key : other.keys)
      if (scene.has(key.name) && std::find(own.begin(), own.end(), key.name) == own.end())
        throw InputError(fmt::format("{}: belongs to another shape ({}); the shape {} has {}",
                                     scene.where(key.name), other.name, kind.name,
                                     fmt::join(own, ", ")));
  return scene;
}

/// About r = 0: out of the plane of the section, which does not change.
void read_meridian_motion(const Scene& scene, RigidMotion<2>& motion) {
  if (motion.velocity[0] != 0)
    throw InputError(scene.where("counter_body.motion.velocity") +
                     ": expected none along r: an axisymmetric body would widen");
  if (given(scene, "counter_body.motion.center"))
    throw InputError(scene.where("counter_body.motion.center") +
                     ": an axisymmetric counter-body turns about r = 0");
  motion.across_by_x[0] = scene.real_if("counter_body.motion.rotation").value_or(0);
}

template <int dim>
void read_motion(const Scene& scene, Section section, CounterBody<dim>& body) {
  Vector<dim> velocity = Vector<dim>::Zero();
  if (given(scene, "counter_body.motion.velocity"))
    velocity = read_point<dim>(scene, "counter_body.motion.velocity");
  body.motion.velocity = velocity;
  if constexpr (dim == 2) {
    body.motion.across = scene.real_if("counter_body.motion.out_of_plane").value_or(0);
    if (section == Section::meridian) return read_meridian_motion(scene, body.motion);
  }
  const double rate = scene.real_if("counter_body.motion.rotation").value_or(0);
  if (rate == 0) return;
  const std::string rotation = "counter_body.motion.rotation";
  const Vector<dim> center = rotation_center<dim>(scene, rotation);
  const double across = body.motion.across;
  body.motion = rigid_motion<dim>(velocity, rotation_spin<dim>(scene, rate, rotation), center);
  body.motion.across = across;
  if (turns_into_itself(body.shape, body.motion.spin, center)) return;
  if (!velocity.isZero(0))
    throw InputError(scene.where("counter_body.motion.velocity") +
                     ": expected none beside a rotation that changes where the shape is: it turns "
                     "on the spot");
  body.turning = Turning<dim>{body.motion.spin, center};
}

/// Throws unless there is one time for each approach, ascending.
LoadHistory read_travel(const Scene& scene) {
  const std::vector<double>& travel = scene.reals("counter_body.press.approach");
  std::vector<double> times = {0};
  if (given(scene, "counter_body.press.times")) times = scene.reals("counter_body.press.times");
  if (travel.empty() || travel.size() != times.size())
    throw InputError(
        fmt::format("{}: expected one number for each of counter_body.press.times, {}, got {}",
                    scene.where("counter_body.press.approach"), times.size(), travel.size()));
  for (const double value : travel)
    if (!std::isfinite(value))
      throw InputError(scene.where("counter_body.press.approach") + ": expected finite numbers");
  const std::size_t misplaced = LoadHistory::first_misplaced(times);
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k]) || k == misplaced)
      throw InputError(
          fmt::format("{}: expected ascending times, one twice for a jump, got {} at place {}",
                      scene.where("counter_body.press.times"), times[k], k + 1));
  return {times, travel};
}

template <int dim>
void read_press(const Scene& scene, Section section, PressedCounterBody<dim>& result) {
  const std::string direction = "counter_body.press.direction";
  const bool force = given(scene, "counter_body.press.force");
  const bool moves = given(scene, "counter_body.press.approach");
  if (force && moves)
    throw InputError(scene.where("counter_body.press.approach") +
                     ": expected either press.approach or press.force, got both");
  const bool times = given(scene, "counter_body.press.times");
  const bool factors = given(scene, "counter_body.press.factors");
  if (factors && !force)
    throw InputError(scene.where("counter_body.press.factors") +
                     ": expected also counter_body.press.force, which they multiply");
  if (force && times != factors)
    throw InputError(
        scene.where(times ? "counter_body.press.times" : "counter_body.press.factors") +
        (times ? ": expected also counter_body.press.factors, at these times"
               : ": expected also counter_body.press.times, of these factors"));
  if (times && !moves && !force)
    throw InputError(scene.where("counter_body.press.times") +
                     ": expected also counter_body.press.approach, at these times, or .force and "
                     ".factors");
  if ((force || moves) && !given(scene, direction))
    throw InputError(
        scene.where(force ? "counter_body.press.force" : "counter_body.press.approach") +
        ": expected also counter_body.press.direction");
  if (!given(scene, direction)) return;
  const Vector<dim> along = read_direction<dim>(scene, direction);
  if (section == Section::meridian && along[0] != 0)
    throw InputError(scene.where(direction) +
                     ": expected the axis of symmetry, [0, 1] or [0, -1], in an axisymmetric "
                     "scene");
  result.body.approach = along.normalized();
  if (force) result.force = scene.real("counter_body.press.force");
  if (moves) result.body.travel = read_travel(scene);
}

}  // namespace

template <int dim>
Vector<dim> rotation_center(const Scene& scene, const std::string& rotation) {
  for (const char* key : {"counter_body.motion.center", "counter_body.center", "counter_body.apex"})
    if (given(scene, key)) return read_point<dim>(scene, key);
  throw InputError(scene.where(rotation) +
                   ": expected also counter_body.motion.center, a point of the axis of rotation");
}

template <int dim>
Tensor<dim> rotation_spin(const Scene& scene, double rate, const std::string& rotation) {
  if constexpr (dim == 2) {
    return spin_in_plane(rate);
  } else {
    for (const char* key : {"counter_body.motion.axis", "counter_body.axis"})
      if (given(scene, key)) return spin_about(read_direction<3>(scene, key), rate);
    throw InputError(scene.where(rotation) +
                     ": expected also counter_body.motion.axis, the direction of the axis of "
                     "rotation");
  }
}

template <int dim>
PressedCounterBody<dim> read_counter_body(const Scene& scene, Section section) {
  check_dimension<dim>(scene);
  const auto& kind =
      Registry<CounterShapeKind<dim>>::find(scene.text("counter_body.shape"), "shape");
  const Scene complete = of_shape(scene, kind);
  PressedCounterBody<dim> result;
  result.body.shape = kind.make(complete, section);
  read_motion(complete, section, result.body);
  read_press(complete, section, result);
  return result;
}

template Vector<2> rotation_center(const Scene&, const std::string&);
template Vector<3> rotation_center(const Scene&, const std::string&);
template Tensor<2> rotation_spin(const Scene&, double, const std::string&);
template Tensor<3> rotation_spin(const Scene&, double, const std::string&);
template PressedCounterBody<2> read_counter_body<2>(const Scene&, Section);
template PressedCounterBody<3> read_counter_body<3>(const Scene&, Section);

}  // namespace gnomon
