#include "part/rolling_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "part/histories.hpp"

namespace gnomon::part {

std::vector<Key> rolling_keys() {
  return {reals_key("rolling.velocity", "mm/s", absent("nothing rolls"), {},
                    "velocity along the surface at which the body's material passes the "
                    "counter-body, whose surface moves along: steady rolling (docs/rolling.md)"),
          reals_key("rolling.creepage", "", absent("none"), {},
                    "velocity of the body's material relative to the counter-body, as rigid "
                    "bodies, by that of rolling: a vector along the surface"),
          real_key("rolling.spin", "1/mm", absent("none"), any_quantity,
                   "in space: the same rotation, about the outward normal of the wearing surface "
                   "where the bodies first touch")};
}

bool rolls(const Scene& scene) {
  return scene.given("rolling.velocity");
}

void require_steady_bodies(const Scene& scene) {
  if (scene.text("model.plane") == "axisymmetric")
    refuse(scene, "model.plane", "\"strain\" where bodies roll");
  if (scene.text("shape.constraint") != "eliminated")
    refuse(scene, "shape.constraint", "\"eliminated\" where bodies roll");
}

namespace {

/// The surface where bodies touch may be inclined against its mean, so that forces are along it.
constexpr double nearly_along = 0.1;
constexpr double rounding = 1e-12;  // of a creepage, as a part of the velocity

template <int dim>
Vector<dim> read_along(const Scene& scene, const std::string& key, const Vector<dim>& outward) {
  Vector<dim> v = read_point<dim>(scene, key);
  if (std::abs(v.dot(outward)) > along_surface * v.norm())
    refuse(scene, key, "a vector along the surfaces of wear.on");
  return v;
}

/// Throws where a scene with [rolling] has what steady rolling does not go with.
void require_steady_state(const Scene& scene) {
  if (scene.given("friction.stick") && !scene.flag("friction.stick"))
    refuse(scene, "friction.stick", "true or none beside [rolling], where friction may stick");
  if (!(scene.real("friction.coefficient") > 0))
    refuse(scene, "friction.coefficient", "a coefficient above zero beside [rolling]");
  require_steady_bodies(scene);
}

/// The creepage of a counter-body that moves as counter_body.motion says where the bodies touch.
template <int dim>
void read_creepage_of_motion(const Vector<dim>& outward, const RigidMotion<dim>& motion,
                             Rolling<dim>& rolling) {
  const double V = rolling.velocity.norm();
  const Vector<dim> n = outward.normalized();
  Vector<dim> v = motion.at(motion.reference);
  v -= n * n.dot(v);
  rolling.creepage = (rolling.velocity - v) / V;
  for (double& component : rolling.creepage)
    if (std::abs(component) < rounding) component = 0;
  if constexpr (dim == 3) {
    const Tensor<3> about = spin_about(n, 1);
    const double rate = about.cwiseProduct(motion.spin).sum() / 2;
    if (std::abs(rate) > rounding * motion.spin.norm()) rolling.spin = about * (-rate / V);
  }
}

/// Of [rolling], or of counter_body.motion, which `other` then no longer has. Returns the key that
/// gives it.
template <int dim>
std::string read_creepage(const Scene& scene, const Vector<dim>& outward, CounterBody<dim>& other,
                          Rolling<dim>& rolling) {
  for (const char* key : {"counter_body.motion.velocity", "counter_body.motion.rotation"}) {
    if (!scene.given(key)) continue;
    for (const char* of : {"rolling.creepage", "rolling.spin"})
      if (scene.given(of)) refuse(scene, of, fmt::format("none beside {}, which gives it", key));
    if (other.motion.across != 0) refuse(scene, key, "none across the plane beside [rolling]");
    read_creepage_of_motion<dim>(outward, other.motion, rolling);
    other.motion = {.reference = other.motion.reference, .normal = other.motion.normal};
    return key;
  }
  if (scene.given("rolling.creepage"))
    rolling.creepage = read_along<dim>(scene, "rolling.creepage", outward);
  if (scene.given("rolling.spin")) {
    if constexpr (dim == 3)
      rolling.spin = spin_about(outward, scene.real("rolling.spin"));
    else
      refuse(scene, "rolling.spin", "none in the plane");
  }
  return "rolling.creepage";
}

}  // namespace

template <int dim>
std::optional<Rolling<dim>> read_rolling(const Scene& scene, const Vector<dim>& outward,
                                         CounterBody<dim>& other) {
  if (!rolls(scene)) {
    for (const Key& key : rolling_keys())
      if (scene.given(key.name)) refuse(scene, key.name, "also rolling.velocity");
    return {};
  }
  require_steady_state(scene);
  Rolling<dim> rolling{.velocity = read_along<dim>(scene, "rolling.velocity", outward),
                       .centre = other.position + other.motion.reference};
  if (!(rolling.velocity.norm() > 0))
    refuse(scene, "rolling.velocity", "a velocity that is not zero");
  const std::string given = read_creepage<dim>(scene, outward, other, rolling);
  for (const Guide<dim>& guide : other.guides) {
    if (guide.creeps() && rolling.creepage.dot(guide.along) != 0)
      refuse(scene, given,
             fmt::format("none along {}.direction, whose force determines it", guide.key));
    if (guide.spins() && !rolling.spin.isZero(0))
      refuse(scene, scene.given("rolling.spin") ? "rolling.spin" : given,
             fmt::format("none about the normal, as {}.moment determines it", guide.key));
  }
  return rolling;
}

namespace {

/// Throws where a counter-body that two guides press could move along the velocity of rolling,
/// where friction does not hold it.
template <int dim>
void require_one_way(const Scene& scene, const Vector<dim>& outward, const Guide<dim>& first,
                     const Guide<dim>& other) {
  const Vector<dim> way = first.along / first.along.dot(outward) -
                          other.along / other.along.dot(outward),
                    velocity = read_point<dim>(scene, "rolling.velocity");
  if (std::abs(way.dot(velocity)) <= along_surface * velocity.norm()) return;
  refuse(scene, other.key + ".direction",
         fmt::format("a direction along the surface, or that of {}, beside [rolling]: a force "
                     "between them is one along each of them, which add up as vectors",
                     first.key));
}

/// Throws unless a moment acts about the normal of the surface.
template <int dim>
void require_about_normal(const Scene& scene, const Vector<dim>& outward, const Guide<dim>& guide) {
  if ((guide.turn * outward).norm() <= along_surface && dim == 3) return;
  refuse(scene, guide.key + ".moment",
         fmt::format("a force along the surface in its place, beside [rolling]: the moment divided "
                     "by the radius{}",
                     dim == 3 ? ", or an axis along the normal of the surface" : ""));
}

}  // namespace

template <int dim>
void let_creep(const Scene& scene, const Vector<dim>& outward, CounterBody<dim>& other) {
  if (other.turning)
    refuse(scene, "counter_body.motion.rotation",
           "a counter-body that looks the same while it turns, beside [rolling]");
  Vector<dim> pressing = Vector<dim>::Zero();
  const Guide<dim>* presses = nullptr;
  for (Guide<dim>& guide : other.guides) {
    if (guide.turns()) {
      require_about_normal(scene, outward, guide);
      guide.creep = 1;
      continue;
    }
    if (std::abs(guide.along.dot(outward)) > nearly_along) {
      require_one_way(scene, outward, presses ? *presses : guide, guide);
      presses = &guide;
      pressing += guide.force.value_or(guide.travel ? guide.travel->factor(0) : 0) * guide.along;
      continue;
    }
    if (guide.travel)
      refuse(scene, guide.key + ".approach",
             "a force along the surface, or rolling.creepage: nothing stays where it is moved to");
    if (!guide.force) continue;
    guide.creep = 1;
    guide.share = 0;
  }
  std::stable_partition(other.guides.begin(), other.guides.end(),
                        [](const Guide<dim>& guide) { return !guide.creeps(); });
  if (other.guides.empty() || other.guides.front().creeps())
    throw InputError(scene.path().string() +
                     ": [[counter_body.press]]: expected also a direction "
                     "into the body, beside those along its surface");
  other.approach = other.guides.front().along;
  if (!pressing.isZero(0)) other.come_along(pressing);
}

template std::optional<Rolling<2>> read_rolling(const Scene&, const Vector<2>&, CounterBody<2>&);
template std::optional<Rolling<3>> read_rolling(const Scene&, const Vector<3>&, CounterBody<3>&);
template void let_creep(const Scene&, const Vector<2>&, CounterBody<2>&);
template void let_creep(const Scene&, const Vector<3>&, CounterBody<3>&);

}  // namespace gnomon::part
