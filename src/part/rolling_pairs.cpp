// Pairs of bodies that roll by the velocities of both.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <map>

#include "mesh/facet_table.hpp"
#include "model/bring_together.hpp"
#include "part/bodies.hpp"
#include "part/body_motions.hpp"
#include "part/histories.hpp"
#include "part/rolling_scene.hpp"

namespace gnomon::part {

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

/// The key of the scene by which the material of a body passes the contact.
template <int dim>
std::string key_of_passing(const Scene& scene, const RollingBody<dim>& body) {
  const std::string velocity = body.table + ".velocity";
  return body.on_axle || !scene.given(velocity) ? body.table + ".rotation" : velocity;
}

/// Throws where the material of a body does not pass the contact.
template <int dim>
void require_passing(const Scene& scene, const RollingBody<dim>& body,
                     const MortarPair<dim>& pair) {
  const Vector<dim>& V = body.velocity;
  if (body.table.empty())
    throw InputError(fmt::format(
        "{}: [[pair]]: expected also [cycle] beside stick, or a [[motion]] of both \"{}\" and "
        "\"{}\", by whose velocities they roll on each other",
        scene.path().string(), pair.bodies[0], pair.bodies[1]));
  if (V.isZero(0))
    refuse(scene, key_of_passing(scene, body),
           "one other than zero where bodies roll, or [cycle] beside stick");
  if (dim == 3 && (V - V.dot(pair.approach) * pair.approach).norm() < along_surface * V.norm())
    refuse(scene, key_of_passing(scene, body),
           fmt::format("a velocity along the contact where bodies roll, got one along its normal, "
                       "({:.4g})",
                       fmt::join(V, ", ")));
}

/// Throws where what a force moves does not go along with the other body.
template <int dim>
void require_common_way(const Scene& scene, const std::array<RollingBody<dim>, 2>& bodies,
                        const MortarPair<dim>& pair) {
  for (const std::size_t side : {0, 1})
    if (pair.velocities[side].isZero(0))
      refuse(scene, key_of_passing(scene, bodies[side]),
             fmt::format("one by which \"{}\" passes the contact along the velocity of \"{}\", "
                         "({:.4g}), got ({:.4g})",
                         pair.bodies[side], pair.bodies[1 - side],
                         fmt::join(bodies[1 - side].velocity, ", "),
                         fmt::join(bodies[side].velocity, ", ")));
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

/// The node of a side of a pair that touches first.
template <int dim>
int first_touch(const MortarPair<dim>& pair, std::size_t side, const Mesh<dim>& mesh) {
  const std::map<int, double> travels =
      travels_of_side<dim>(pair, static_cast<int>(side), mesh.nodes);
  const auto travel = [](const auto& each) { return each.second; };
  if (travels.empty()) return (side == 0 ? pair.slave : pair.master).front().front();
  return std::ranges::min_element(travels, {}, travel)->first;
}

/// Of a body that turns about an axle, where it touches first; along the contact.
template <int dim>
Vector<dim> velocity_of_rim(const Scene& scene, const RollingBody<dim>& body,
                            const MortarPair<dim>& pair, std::size_t side,
                            const Vector<dim>& touches) {
  const Vector<dim> outward = side == 0 ? Vector<dim>(-pair.approach) : pair.approach,
                    along = body.spin * outward;
  if (along.norm() < along_surface * body.spin.norm())
    refuse(scene, body.table + ".rotation",
           "also the velocity of the material where it touches, beside a rotation about the normal "
           "of the contact");
  const Vector<dim> rim = body.spin * (touches - body.centre);
  return std::copysign(rim.norm(), rim.dot(along)) * along.normalized();  // against it in a bore
}

/// A cone also turns about the normal of its contact.
template <int dim>
void tell_left_out_spin(const RollingBody<dim>& body, const MortarPair<dim>& pair, std::size_t side,
                        int node, AssemblyParts<dim>& parts) {
  constexpr double little = 1e-3;
  Vector<dim> normal = Vector<dim>::Zero();
  for (const auto& facet : side == 0 ? pair.slave : pair.master)
    if (std::ranges::count(facet, node) > 0)
      normal += facet_normal<dim>(facet, parts.mesh.nodes).normalized();
  const double rate = body.spin.norm() / std::sqrt(2.0),
               across = (body.spin * normal.normalized()).norm() / rate;
  const double about = std::sqrt(std::max(0.0, 1 - across * across));
  if (about > little)
    parts.remarks.push_back(
        fmt::format("\"{}\" turns by {:.3g} rad/s about the normal of its contact, which rolling "
                    "leaves out: with its velocity given, a rotation of the other body has it",
                    pair.bodies[side], about * rate));
}

/// The velocities of both bodies; alike along what a force determines, where the search begins.
template <int dim>
void read_velocities(const Scene& scene, AssemblyParts<dim>& parts, MortarPair<dim>& pair) {
  std::array<RollingBody<dim>, 2> bodies;
  for (std::size_t side = 0; side < 2; ++side) {
    RollingBody<dim>& body = bodies[side] = read_rolling_body(scene, parts, pair.bodies[side]);
    if (body.on_axle) {
      const int node = first_touch<dim>(pair, side, parts.mesh);
      body.velocity = velocity_of_rim<dim>(scene, body, pair, side,
                                           parts.mesh.nodes[static_cast<std::size_t>(node)]);
      tell_left_out_spin<dim>(body, pair, side, node, parts);
    }
    require_passing<dim>(scene, body, pair);
    pair.velocities[side] = body.velocity;
  }
  require_along_each_other(scene, bodies);
  for (const RollingBody<dim>& body : bodies)
    if (body.force[0] && bodies[0].velocity.dot(bodies[1].velocity) < 0)
      refuse(scene, body.table + (body.on_axle ? ".rotation" : ".velocity"),
             "one by which both bodies go the same way where they touch");
  for (std::size_t side = 0; side < 2; ++side)
    for (int i = 0; i < dim; ++i)
      if (bodies[side].force[i != axis_along<dim>(bodies[side].velocity)])
        pair.velocities[side][i] = bodies[1 - side].velocity[i];
  require_common_way<dim>(scene, bodies, pair);
}

/// About the normal of the contact, of one of the bodies: a rotation, or a moment on it.
template <int dim>
void read_spin(const Scene& scene, const RollingBody<dim>& body, const Vector<dim>& approach,
               double sign, Rolling<dim>& rolling) {
  if ((body.spin.isZero(0) && !body.moment) || body.on_axle) return;
  const std::string key = body.table + (body.moment ? ".moment" : ".rotation");
  const Tensor<dim> turn = body.moment ? body.turn : body.spin;
  if ((turn * approach).norm() > along_surface * turn.norm())
    refuse(scene, key,
           "an axis along the normal of the contact where bodies roll: a rotation about the axle "
           "is one without a velocity, and a moment about it a force where they touch");
  if (!rolling.spin.isZero(0) || rolling.moment)
    refuse(scene, key, "a rotation or a moment of one of the two bodies");
  rolling.centre = body.centre;
  rolling.spin = sign / rolling.velocity.norm() * body.spin;
  if (!body.moment) return;
  rolling.moment = sign * *body.moment;
  rolling.turn = body.turn;
}

}  // namespace

template <int dim>
Rolling<dim> rolling_of(const Scene& scene, const AssemblyParts<dim>& parts) {
  const MortarPair<dim>& pair = parts.pairs.front();
  const auto& [V, other] = pair.velocities;
  Rolling<dim> rolling{
      .velocity = V, .creepage = (V - other) / V.norm(), .linear = has_small_strains(parts.bodies)};
  for (const bool master : {false, true}) {
    auto body = read_rolling_body(scene, parts, pair.bodies[master]);
    if (body.on_axle) body.velocity = pair.velocities[master];
    read_forces(scene, body, pair, master, rolling);
    read_spin(scene, body, pair.approach, master ? -1 : 1, rolling);
  }
  if (parts.pairs.size() > 1 && (rolling.creeps() || !rolling.spin.isZero(0)))
    throw InputError(scene.path().string() +
                     ": [[motion]]: expected velocities alone where several pairs roll, and no "
                     "force, spin or moment");
  return rolling;
}

template <int dim>
void let_roll(const Scene& scene, AssemblyParts<dim>& parts) {
  for (MortarPair<dim>& pair : parts.pairs) {
    read_velocities(scene, parts, pair);
    if (!(pair.friction > 0))
      refuse(scene, "friction.coefficient", "a coefficient above zero where bodies roll");
  }
  require_steady_bodies(scene);
  parts.interface.sticks = false;
  parts.interface.rolling = rolling_of(scene, parts);
}

template Rolling<2> rolling_of(const Scene&, const AssemblyParts<2>&);
template Rolling<3> rolling_of(const Scene&, const AssemblyParts<3>&);
template void let_roll(const Scene&, AssemblyParts<2>&);
template void let_roll(const Scene&, AssemblyParts<3>&);

}  // namespace gnomon::part
