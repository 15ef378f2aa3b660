#include "part/rolling_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "part/bodies.hpp"
#include "part/body_motions.hpp"
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

namespace {

constexpr double along_surface = 1e-3;  // cosine
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

/// Throws where the bodies have what steady rolling does not go with.
void require_steady_bodies(const Scene& scene) {
  if (scene.text("model.plane") == "axisymmetric")
    refuse(scene, "model.plane", "\"strain\" where bodies roll");
  if (scene.text("shape.constraint") != "eliminated")
    refuse(scene, "shape.constraint", "\"eliminated\" where bodies roll");
}

/// The same of a scene with [rolling].
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
  for (const Guide<dim>& guide : other.guides)
    if (guide.creeps() && rolling.creepage.dot(guide.along) != 0)
      refuse(scene, given,
             fmt::format("none along {}.direction, whose force determines it", guide.key));
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

}  // namespace

template <int dim>
void let_creep(const Scene& scene, const Vector<dim>& outward, CounterBody<dim>& other) {
  if (other.turning)
    refuse(scene, "counter_body.motion.rotation",
           "a counter-body that looks the same while it turns, beside [rolling]");
  Vector<dim> pressing = Vector<dim>::Zero();
  const Guide<dim>* presses = nullptr;
  for (Guide<dim>& guide : other.guides) {
    if (guide.turns())
      refuse(scene, guide.key + ".moment",
             "a force along the surface in its place, beside [rolling]: the moment divided by the "
             "radius");
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

namespace {

constexpr double near_axis = 1e-6;

/// The axis along which a vector points, or -1.
template <int dim>
int axis_along(const Vector<dim>& v) {
  Eigen::Index axis = 0;
  const double most = v.cwiseAbs().maxCoeff(&axis);
  return (v - v[axis] * Vector<dim>::Unit(axis)).norm() < near_axis * most ? static_cast<int>(axis)
                                                                           : -1;
}

/// Makes the creepage unknown along what a force on the slave, or `reversed` on the master,
/// determines.
template <int dim>
void read_forces(const Scene& scene, const RollingBody<dim>& body, const MortarPair<dim>& pair,
                 bool reversed, Rolling<dim>& rolling) {
  const int along = axis_along<dim>(body.velocity), into = axis_along<dim>(pair.approach);
  const auto take = [&](const std::string& key, int axis, double value) {
    if (rolling.force[axis])
      refuse(scene, key, "a force on one of the two bodies: the other one has its opposite");
    rolling.force[axis] = reversed ? -value : value;
  };
  const auto [drives, across] = body.force;
  const std::string key = body.table + ".force", sideways = key + "_across";
  if (drives && along < 0) refuse(scene, key, "a velocity along an axis of the scene beside it");
  if (drives) take(key, along, std::copysign(1.0, body.velocity[along]) * *drives);
  if (!across) return;
  if (dim == 2) refuse(scene, sideways, "none in the plane");
  if (along < 0 || into < 0 || along == into)
    refuse(scene, sideways, "a velocity and a load along axes of the scene beside it");
  take(sideways, 3 - along - into, *across);
}

/// Throws where bodies in the plane, whose surfaces touch along a line, move to or from each other.
template <int dim>
void require_along_each_other(const Scene& scene, const std::array<RollingBody<dim>, 2>& bodies) {
  constexpr double digits = 1e-9;  // of a velocity
  const Vector<dim>&V = bodies[0].velocity, &other = bodies[1].velocity;
  const double size = V.norm() * other.norm();
  if (dim == 3 || size == 0) return;
  const double off = std::abs(V[0] * other[1] - V[1] * other[0]);
  if (off > std::max(digits * size, along_surface * V.norm() * (V - other).norm()))
    refuse(scene, bodies[0].table + ".velocity",
           fmt::format("a velocity along the line of that of {}, which is that of the surfaces: "
                       "across it the bodies part",
                       bodies[1].table));
}

/// The velocities of both bodies; alike along what a force determines, where the search begins.
template <int dim>
void read_velocities(const Scene& scene, const AssemblyParts<dim>& parts, MortarPair<dim>& pair) {
  std::array<RollingBody<dim>, 2> bodies;
  for (std::size_t side = 0; side < 2; ++side) {
    bodies[side] = read_rolling_body(scene, parts, pair.bodies[side]);
    pair.velocities[side] = bodies[side].velocity;
  }
  require_along_each_other(scene, bodies);
  for (std::size_t side = 0; side < 2; ++side)
    for (int i = 0; i < dim; ++i)
      if (bodies[side].force[i != axis_along<dim>(bodies[side].velocity)])
        pair.velocities[side][i] = bodies[1 - side].velocity[i];
}

/// About the normal of the contact, of one of the bodies.
template <int dim>
void read_spin(const Scene& scene, const RollingBody<dim>& body, const Vector<dim>& approach,
               double rate, Rolling<dim>& rolling) {
  if (body.spin.isZero(0)) return;
  const std::string key = body.table + ".rotation";
  if ((body.spin * approach).norm() > along_surface * body.spin.norm())
    refuse(scene, key,
           "a rotation about the normal of the contact where bodies roll: that about the axle is "
           "the velocity of the material where it touches");
  if (!rolling.spin.isZero(0)) refuse(scene, key, "a rotation of one of the two bodies");
  rolling.spin = rate * body.spin;
  rolling.centre = body.centre;
}

}  // namespace

template <int dim>
Rolling<dim> rolling_of(const Scene& scene, const AssemblyParts<dim>& parts) {
  const MortarPair<dim>& pair = parts.pairs.front();
  const auto& [V, other] = pair.velocities;
  Rolling<dim> rolling{
      .velocity = V, .creepage = (V - other) / V.norm(), .linear = has_small_strains(parts.bodies)};
  for (const bool master : {false, true}) {
    const auto body = read_rolling_body(scene, parts, pair.bodies[master]);
    read_forces(scene, body, pair, master, rolling);
    read_spin(scene, body, pair.approach, (master ? -1 : 1) / V.norm(), rolling);
  }
  if (parts.pairs.size() > 1 && (rolling.creeps() || !rolling.spin.isZero(0)))
    throw InputError(scene.path().string() +
                     ": [[motion]]: expected velocities alone where several pairs roll, and no "
                     "force or rotation");
  return rolling;
}

template <int dim>
void let_roll(const Scene& scene, AssemblyParts<dim>& parts) {
  for (MortarPair<dim>& pair : parts.pairs) {
    read_velocities(scene, parts, pair);
    for (const Vector<dim>& V : pair.velocities)
      if (!(V.norm() > 0))
        throw InputError(fmt::format(
            "{}: [[pair]]: expected also [cycle] beside stick, or a [[motion]] of both \"{}\" and "
            "\"{}\", by whose velocities they roll on each other",
            scene.path().string(), pair.bodies[0], pair.bodies[1]));
    if (!(pair.friction > 0))
      refuse(scene, "friction.coefficient", "a coefficient above zero where bodies roll");
  }
  require_steady_bodies(scene);
  parts.interface.sticks = false;
  parts.interface.rolling = rolling_of(scene, parts);
}

template <int dim>
bool slips_as_given(const AssemblyParts<dim>& parts) {
  const Rolling<dim>& rolling = *parts.interface.rolling;
  const bool is_given = !rolling.creepage.isZero(0) || !rolling.spin.isZero(0);
  return is_given && !rolling.creeps() &&
         std::ranges::none_of(parts.interface.partner.guides, &Guide<dim>::creeps);
}

namespace {

/// Of what friction can hold, the part that forces along the surface take up, mean over the run; 0
/// where none is given.
template <int dim>
double part_of_friction(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  const double duration = expected.scales.duration;
  Vector<dim> along = Vector<dim>::Zero();
  for (const Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.creeps() && guide.force)
      along += *guide.force * guide.factors.integral(duration) / duration * guide.along;
  for (int i = 0; i < dim; ++i) along[i] += parts.interface.rolling->force[i].value_or(0);
  const Pressing press = pressing_of(parts, duration);
  const double across = press.force > 0 ? press.impulse / duration : expected.scales.force;
  return across > 0 ? std::min(1.0, along.norm() / (parts.interface.friction * across)) : 0;
}

/// The mean slip, by pressures, that makes those forces, divided by the velocity: of Carter's
/// contact, in space of J. K. Vermeulen's and K. L. Johnson's, by the mean strain of the contact.
template <int dim>
double slip_by_forces(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  constexpr double least = 0.3;  // unlike bodies slip where they roll freely
  constexpr double limit = dim == 2 ? 8 / M_PI : 3;
  const double part = std::max(least, part_of_friction(parts, expected)),
               creepage = 1 - std::pow(1 - part, 1.0 / dim);
  return limit * parts.interface.friction * expected.strain * part * creepage;
}

}  // namespace

template <int dim>
double speed_of_rolling(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  const Rolling<dim>& rolling = *parts.interface.rolling;
  const double spin = rolling.spin.norm() / std::sqrt(2);  // of a skew tensor
  const double half = contact_width<dim>(expected.scales) / 2,
               given = rolling.creepage.norm() + half * spin,
               found = slips_as_given(parts) ? 0 : slip_by_forces(parts, expected);
  return rolling.velocity.norm() * (given + found);
}

template <int dim>
void scale_creepages(const Magnitudes& expected, AssemblyParts<dim>& parts) {
  for (Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.creeps()) guide.creep = contact_width<dim>(expected.scales) / 2;
  parts.interface.rolling->creepage_scale =
      expected.scales.displacement / (contact_width<dim>(expected.scales) / 2);
}

template std::optional<Rolling<2>> read_rolling(const Scene&, const Vector<2>&, CounterBody<2>&);
template std::optional<Rolling<3>> read_rolling(const Scene&, const Vector<3>&, CounterBody<3>&);
template bool slips_as_given(const AssemblyParts<2>&);
template bool slips_as_given(const AssemblyParts<3>&);
template Rolling<2> rolling_of(const Scene&, const AssemblyParts<2>&);
template Rolling<3> rolling_of(const Scene&, const AssemblyParts<3>&);
template void let_roll(const Scene&, AssemblyParts<2>&);
template void let_roll(const Scene&, AssemblyParts<3>&);
template void let_creep(const Scene&, const Vector<2>&, CounterBody<2>&);
template void let_creep(const Scene&, const Vector<3>&, CounterBody<3>&);
template double speed_of_rolling(const AssemblyParts<2>&, const Magnitudes&);
template double speed_of_rolling(const AssemblyParts<3>&, const Magnitudes&);
template void scale_creepages(const Magnitudes&, AssemblyParts<2>&);
template void scale_creepages(const Magnitudes&, AssemblyParts<3>&);

}  // namespace gnomon::part
