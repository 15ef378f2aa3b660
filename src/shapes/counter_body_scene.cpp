#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <gnomon/shapes/shape_keys.hpp>
#include <set>
#include <tuple>

#include "base/spectrum.hpp"
#include "shapes/guide_order.hpp"

namespace gnomon {

namespace {

void require_none_in_plane(const Scene& scene, const std::string& key) {
  if (scene.given(key)) throw InputError(scene.where(key) + ": there is no such key in the plane");
}

/// Those of scenes in the plane or in space.
std::vector<Key> keys_of(const CounterShapeKind& kind, int dim) {
  std::vector<Key> keys = kind.keys;
  if (dim == 3) keys.insert(keys.end(), kind.keys_in_space.begin(), kind.keys_in_space.end());
  return keys;
}

/// The scene with the defaults of the shape. Throws where a key of it is missing, or one is given
/// that only other shapes have.
Scene of_shape(Scene scene, const CounterShapeKind& kind, int dim) {
  std::vector<std::string> names;
  for (const Key& key : keys_of(kind, dim)) {
    names.push_back(key.name);
    if (scene.has(key.name) || !key.absent_meaning.empty()) continue;
    if (key.required())
      throw InputError(fmt::format("{}: expected also {}, {}", scene.where("counter_body.shape"),
                                   key.name, key.help));
    scene = scene.with(key.name, *key.default_value);
  }
  for (const CounterShapeKind& other : Registry<CounterShapeKind>::all())
    for (const Key& key : keys_of(other, 3))
      if (scene.has(key.name) && std::ranges::find(names, key.name) == names.end())
        throw InputError(fmt::format("{}: belongs to another shape ({}); the shape {} has {}",
                                     scene.where(key.name), other.name, kind.name,
                                     fmt::join(names, ", ")));
  return scene;
}

template <int dim>
const CounterShapeMaker<dim>& maker_of(const CounterShapeKind& kind, const Scene& scene) {
  const CounterShapeMaker<dim>& maker = std::get<dim - 2>(std::tie(kind.in_plane, kind.in_space));
  if (!maker)
    throw InputError(fmt::format("{}: there is no {} {}", scene.where("counter_body.shape"),
                                 kind.name, dim == 2 ? "in the plane" : "in space"));
  return maker;
}

/// About r = 0: out of the plane of the section, which does not change.
void read_meridian_motion(const Scene& scene, RigidMotion<2>& motion) {
  if (motion.velocity[0] != 0)
    throw InputError(scene.where("counter_body.motion.velocity") +
                     ": expected none along r: an axisymmetric body would widen");
  if (scene.given("counter_body.motion.center"))
    throw InputError(scene.where("counter_body.motion.center") +
                     ": an axisymmetric counter-body turns about r = 0");
  motion.across_by_x[0] = scene.real_if("counter_body.motion.rotation").value_or(0);
}

/// In the plane with what is out of it, a third component.
template <int dim>
std::pair<Vector<dim>, double> surface_velocity(const Scene& scene) {
  const std::string key = "counter_body.motion.velocity";
  if (!scene.given(key)) return {Vector<dim>::Zero(), 0.0};
  const std::vector<double>& components = scene.reals(key);
  if (dim == 3 || components.size() != 3) return {read_point<dim>(scene, key), 0.0};
  return {Eigen::Map<const Vector<dim>>(components.data()), components[2]};
}

template <int dim>
void read_motion(const Scene& scene, Section section, CounterBody<dim>& body) {
  const auto [velocity, across] = surface_velocity<dim>(scene);
  body.motion.velocity = velocity;
  body.motion.across = across;
  if constexpr (dim == 2) {
    require_none_in_plane(scene, "counter_body.motion.axis");
    if (section == Section::meridian) return read_meridian_motion(scene, body.motion);
  }
  const double rate = scene.real_if("counter_body.motion.rotation").value_or(0);
  if (rate == 0) return;
  const std::string rotation = "counter_body.motion.rotation";
  const Vector<dim> center = rotation_center<dim>(scene, rotation);
  body.motion = rigid_motion<dim>(velocity, rotation_spin<dim>(scene, rate, rotation), center);
  body.motion.across = across;
  if (turns_into_itself(body.shape, body.motion.spin, center)) return;
  if (!velocity.isZero(0))
    throw InputError(scene.where("counter_body.motion.velocity") +
                     ": expected none beside a rotation that changes where the shape is: it turns "
                     "on the spot");
  body.turning = Turning<dim>{body.motion.spin, center};
}

/// `values` over the times of a press. Throws unless there is one time for each, ascending.
LoadHistory read_over_time(const Scene& scene, const std::string& press,
                           const std::string& values) {
  const std::string times_key = press + ".times";
  std::vector<double> times = {0};
  if (scene.given(times_key)) times = scene.reals(times_key);
  const std::vector<double>& numbers = scene.reals(values);
  if (numbers.empty() || numbers.size() != times.size())
    throw InputError(fmt::format("{}: expected one number for each of {}, {}, got {}",
                                 scene.where(values), times_key, times.size(), numbers.size()));
  for (const double number : numbers)
    if (!std::isfinite(number)) throw InputError(scene.where(values) + ": expected finite numbers");
  const std::size_t misplaced = LoadHistory::first_misplaced(times);
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k]) || k == misplaced)
      throw InputError(
          fmt::format("{}: expected ascending times, one twice for a jump, got {} at place {}",
                      scene.where(times_key), times[k], k + 1));
  return {times, numbers};
}

/// Throws where one key of a press needs or excludes another.
void check_press(const Scene& scene, const std::string& press) {
  const auto has = [&](const char* key) { return scene.given(press + key); };
  const auto refuse = [&](const char* key, const std::string& expected) {
    throw InputError(scene.where(press + key) + ": expected " + expected);
  };
  const bool force = has(".force"), moves = has(".approach"), moment = has(".moment");
  if (force && moves) refuse(".approach", "either press.approach or press.force, got both");
  for (const char* other : {".direction", ".force", ".approach"})
    if (moment && has(other)) refuse(".moment", "either a moment or press" + std::string(other));
  for (const char* of_moment : {".center", ".axis"})
    if (!moment && has(of_moment)) refuse(of_moment, "also " + press + ".moment");
  const bool times = has(".times"), factors = has(".factors"),
             loaded = force || moment || scene.given("cycle.force");
  if (factors && !loaded) refuse(".factors", "also " + press + ".force, which they multiply");
  if (loaded && times != factors)
    refuse(times ? ".times" : ".factors", times ? "also " + press + ".factors, at these times"
                                                : "also " + press + ".times, of these factors");
  if (times && !moves && !loaded)
    refuse(".times", "also " + press + ".approach, at these times, or .force and .factors");
  if ((force || moves) && !has(".direction"))
    refuse(force ? ".force" : ".approach", "also " + press + ".direction");
}

template <int dim>
Guide<dim> read_guide(const Scene& scene, const std::string& press, Section section) {
  check_press(scene, press);
  if (dim == 2) require_none_in_plane(scene, press + ".axis");
  Guide<dim> guide{.key = press};
  if (scene.given(press + ".factors"))
    guide.factors = read_over_time(scene, press, press + ".factors");
  if (scene.given(press + ".moment")) {
    if (section == Section::meridian)
      throw InputError(scene.where(press + ".moment") + ": expected none in an axisymmetric scene");
    guide.force = scene.real(press + ".moment");
    guide.turn = rotation_spin<dim>(scene, 1, press + ".moment", press + ".axis");
    guide.centre = rotation_center<dim>(scene, press + ".moment", press + ".center");
    return guide;
  }
  if (!scene.given(press + ".direction"))
    throw InputError(scene.path().string() + ": [[counter_body.press]]: expected " + press +
                     ".direction or .moment");
  const Vector<dim> along = read_direction<dim>(scene, press + ".direction");
  if (section == Section::meridian && along[0] != 0)
    throw InputError(
        scene.where(press + ".direction") +
        ": expected the axis of symmetry, [0, 1] or [0, -1], in an axisymmetric scene");
  guide.along = along.normalized();
  if (scene.given(press + ".force")) guide.force = scene.real(press + ".force");
  if (scene.given(press + ".approach"))
    guide.travel = read_over_time(scene, press, press + ".approach");
  return guide;
}

/// The table `press`, or the entries of an array of it; none where the scene has neither.
std::vector<std::string> press_tables(const Scene& scene) {
  std::set<std::string> tables;
  for (const Key& key : counter_body_keys()) {
    if (!key.name.starts_with("counter_body.press.")) continue;
    if (scene.given(key.name)) tables.insert("counter_body.press");
    for (const std::string& number : scene.chosen_names(key.name))
      tables.insert("counter_body.press." + number);
  }
  if (tables.size() > 1 && tables.contains("counter_body.press"))
    throw InputError(scene.path().string() +
                     ": expected either [counter_body.press] or [[counter_body.press]], got both");
  return {tables.begin(), tables.end()};
}

/// A motion of the free guides that leaves the surface where it is would be determined by nothing,
/// but for friction that sticks.
template <int dim>
void require_determined(const Scene& scene, const CounterBody<dim>& body) {
  std::vector<const Guide<dim>*> free;
  for (const Guide<dim>& guide : body.guides)
    if (guide.force) free.push_back(&guide);
  const auto count = static_cast<Eigen::Index>(free.size());
  const bool sticks = (scene.given("friction.stick") && scene.flag("friction.stick")) ||
                      scene.given("rolling.velocity");
  if (count < 2 || sticks) return;
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(count, count);
  const double reach = body.shape.reach(), arm = reach > 0 ? reach : 1;
  visit_surface<dim>(
      body.shape, Vector<dim>::Zero(), [&](const Vector<dim>& x, const Vector<dim>& n) {
        Eigen::VectorXd out(count);
        for (Eigen::Index k = 0; k < count; ++k)
          out[k] = free[k]->turns() ? n.dot(free[k]->turn * (x - free[k]->centre)) / arm
                                    : n.dot(free[k]->along);
        moved += out * out.transpose();
      });
  const auto [values, vectors] = spectrum_of(moved);
  if (values[0] > 1e-12 * moved.trace()) return;
  constexpr double some = 1e-6;
  double turned = 0;  // the part of a turn in that motion
  for (Eigen::Index k = 0; k < count; ++k)
    if (free[k]->turns()) turned = std::abs(vectors(k, 0));
  throw InputError(fmt::format(
      "{}: expected a motion that changes where the surface is, but {}: nothing determines how far "
      "it {}",
      scene.path().string() + ": [[counter_body.press]]",
      turned < some       ? "the shape looks the same when it moves along its free directions"
      : turned > 1 - some ? "the shape is round about the axis of the moment"
                          : "to turn about the axis of the moment moves it as another entry does",
      turned > 1 - some ? "turns" : "moves"));
}

template <int dim>
void read_press(const Scene& scene, Section section, const std::vector<Vector<dim>>& normals,
                CounterBody<dim>& body) {
  for (const std::string& press : press_tables(scene))
    body.guides.push_back(read_guide<dim>(scene, press, section));
  if (body.guides.empty()) return;
  order_guides(scene, normals, body);
  const auto turns = std::ranges::count_if(body.guides, &Guide<dim>::turns);
  if (turns > 1 || (turns > 0 && body.turning))
    throw InputError(scene.path().string() +
                     ": [[counter_body.press]]: expected one moment at most, and none beside a "
                     "motion.rotation that turns the shape");
  require_determined(scene, body);
}

}  // namespace

template <int dim>
Vector<dim> rotation_center(const Scene& scene, const std::string& rotation,
                            const std::string& center) {
  for (const std::string& key : {center, std::string("counter_body.center")})
    if (scene.given(key)) return read_point<dim>(scene, key);
  throw InputError(scene.where(rotation) + ": expected also " + center +
                   ", a point of the axis of rotation");
}

template <int dim>
Tensor<dim> rotation_spin(const Scene& scene, double rate, const std::string& rotation,
                          const std::string& axis) {
  if constexpr (dim == 2) {
    return spin_in_plane(rate);
  } else {
    for (const std::string& key : {axis, std::string("counter_body.axis")})
      if (scene.given(key)) return spin_about(read_direction<3>(scene, key), rate);
    throw InputError(scene.where(rotation) + ": expected also " + axis +
                     ", the direction of the axis of rotation");
  }
}

template <int dim>
CounterBody<dim> read_counter_body(const Scene& scene, Section section,
                                   const std::vector<Vector<dim>>& normals) {
  const auto& kind = Registry<CounterShapeKind>::find(scene.text("counter_body.shape"), "shape");
  const Scene complete = of_shape(scene, kind, dim);
  CounterBody<dim> body;
  body.shape = maker_of<dim>(kind, scene)(complete, section);
  read_motion(complete, section, body);
  read_press(complete, section, normals, body);
  return body;
}

template Vector<2> rotation_center(const Scene&, const std::string&, const std::string&);
template Vector<3> rotation_center(const Scene&, const std::string&, const std::string&);
template Tensor<2> rotation_spin(const Scene&, double, const std::string&, const std::string&);
template Tensor<3> rotation_spin(const Scene&, double, const std::string&, const std::string&);
template CounterBody<2> read_counter_body<2>(const Scene&, Section, const std::vector<Vector<2>>&);
template CounterBody<3> read_counter_body<3>(const Scene&, Section, const std::vector<Vector<3>>&);

}  // namespace gnomon
