#include "part/pairs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"
#include "model/rigid_parts.hpp"
#include "part/body_motions.hpp"
#include "part/boundary_beside.hpp"
#include "part/carried_bodies.hpp"
#include "part/facing_facets.hpp"
#include "part/facing_refusal.hpp"
#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/pair_cycle.hpp"
#include "part/pair_keys.hpp"
#include "part/rolling_scene.hpp"
#include "part/surfaces.hpp"

namespace gnomon::part {

namespace {

/// The two bodies of a pair, by their names.
std::array<int, 2> bodies_of_pair(const Scene& scene, const std::string& pair,
                                  const std::vector<Body>& bodies) {
  std::array<int, 2> result{};
  for (std::size_t side = 0; side < 2; ++side)
    result[side] = static_cast<int>(
        std::ranges::find(bodies, scene.texts(pair + ".bodies")[side], &Body::name) -
        bodies.begin());
  return result;
}

/// The boundary of a body, up to the edges of its wearing surfaces, or the part of it that the pair
/// is restricted to.
template <int dim>
Facets<dim> boundary_of(const Scene& scene, const std::string& pair, const ImportedBody<dim>& part,
                        const BodyOfFacets<dim>& body_of, const Facets<dim>& wearing, int body) {
  const std::string key = pair + ".surfaces";
  Facets<dim> result;
  const auto take = [&](const Facets<dim>& facets) {
    for (const auto& facet : facets)
      if (body_of(facet) == body) result.push_back(facet);
  };
  if (!scene.given(key)) {
    take(part.exterior);
    drop_across_edges(part.mesh.nodes, wearing, result);
    return result;
  }
  for (const std::string& name : scene.texts(key)) take(group_facets(scene, key, name, part));
  if (result.empty()) refuse(scene, key, "surfaces of both bodies");
  return result;
}

/// How loads move the middle of some facets of a body that supports let turn, as a lever on its
/// pivot, without regard to the size; zero where they do not.
template <int dim>
Vector<dim> turned_by_loads(const AssemblyParts<dim>& parts, const NodalField<dim>& forces,
                            const Facets<dim>& facets) {
  const std::set<int> nodes = nodes_of_facets(facets);
  Vector<dim> middle = Vector<dim>::Zero();
  for (const int node : nodes) middle += parts.mesh.nodes[node] / double(nodes.size());
  for (const RigidPart<dim>& part : rigid_parts(parts, parts.mesh.nodes, springs_hold(parts))) {
    if (part.loose.cols() == 0 || !part.has(*nodes.begin())) continue;
    const auto velocities = [&](const Vector<dim>& x) {
      return rigid_velocities<dim>(x, part.centre, part.size);
    };
    Twist<dim> load = Twist<dim>::Zero();
    for (const int node : part.nodes)
      load += velocities(parts.mesh.nodes[node]).transpose() * forces.row(node).transpose();
    return velocities(middle) * (part.loose * (part.loose.transpose() * load));
  }
  return Vector<dim>::Zero();
}

/// The direction in which the master comes near: against the loads on a slave that nothing holds
/// there, or that they turn, along those on such a master, else into the surface of the slave.
template <int dim>
Vector<dim> approach_of(const MortarPair<dim>& pair, const AssemblyParts<dim>& parts,
                        const std::array<int, 2>& bodies) {
  constexpr double away = 0.1;  // cosine
  constexpr double rounding = 1e-9;
  Vector<dim> outward = Vector<dim>::Zero();
  double area = 0;  // a surface all around has no direction of its own
  for (const auto& patch : contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section())) {
    outward += patch.initial_area * patch.initial_normal;
    area += patch.initial_area;
  }
  const std::vector<int> body_of =
      body_of_nodes(parts.mesh, body_of_cells(parts.bodies, parts.mesh.cells.size()));
  std::array<Vector<dim>, 2> load = {Vector<dim>::Zero(), Vector<dim>::Zero()};
  std::array<Vector<dim>, 2> held = load;
  std::array<double, 2> whole{};  // of loads that cancel each other rounding is left
  NodalField<dim> forces =
      NodalField<dim>::Zero(static_cast<Eigen::Index>(parts.mesh.nodes.size()), dim);
  for (const Load<dim>& each : parts.loads) forces += forces_of(each, parts);
  for (const SpringSupport<dim>& each : parts.supports.springs) forces += pull_of(each, parts);
  if (parts.section() == Section::meridian) forces.col(0).setZero();  // all around: no resultant
  for (std::size_t node = 0; node < body_of.size(); ++node)
    for (std::size_t side = 0; side < 2; ++side) {
      if (body_of[node] != bodies[side]) continue;
      const auto row = static_cast<Eigen::Index>(node);
      for (int i = 0; i < dim; ++i) held[side][i] += parts.supports.held(row, i);
      load[side] += forces.row(row).transpose();
      whole[side] += forces.row(row).norm();
    }
  for (std::size_t side = 0; side < 2; ++side) {
    // A load along directions that supports hold does not press.
    const Vector<dim> free = (held[side].array() == 0).select(load[side], 0.0);
    const Vector<dim> presses = side == 0 ? Vector<dim>(-free) : free;
    if (presses.norm() > rounding * whole[side] &&
        presses.dot(outward) <= away * presses.norm() * area)
      return presses.normalized();
  }
  for (std::size_t side = 0; side < 2; ++side) {  // but it may turn into the surface
    const Vector<dim> moves =
        turned_by_loads<dim>(parts, forces, side == 0 ? pair.slave : pair.master);
    const Vector<dim> presses = side == 0 ? Vector<dim>(-moves) : moves;
    const bool all_around = outward.norm() <= away * area;
    if (presses.norm() > rounding * whole[side] &&
        (all_around || presses.dot(outward) <= -away * presses.norm() * outward.norm()))
      return presses.normalized();
  }
  return outward.norm() > 0 ? Vector<dim>(-outward.normalized()) : Vector<dim>::Unit(dim - 1);
}

/// A body that moves, or what is bonded to it, slides on another one.
template <int dim>
void require_moving_pairs(const Scene& scene, const AssemblyParts<dim>& parts) {
  const std::vector<std::string> names = separate_bodies(scene);
  const std::vector<int> part = connected_parts(parts.mesh, parts.bodies);
  std::set<int> paired;
  for (std::size_t b = 0; b < part.size(); ++b)
    if (std::ranges::count(names, parts.bodies[b].name) > 0) paired.insert(part[b]);
  const auto is_paired = [&](const std::string& name) {
    const auto body = std::ranges::find(parts.bodies, name, &Body::name);
    return body != parts.bodies.end() && paired.contains(part[body - parts.bodies.begin()]);
  };
  for (const std::string& motion : scene.chosen_names("motion.#.body")) {
    const std::string key = "motion." + motion + ".body";
    if (!is_paired(scene.text(key)))
      throw InputError(fmt::format("{}: expected a body of a [[pair]], \"{}\", got \"{}\"",
                                   scene.where(key), fmt::join(names, "\", \""), scene.text(key)));
  }
}

/// Of a body, which is at rest without one.
template <int dim>
RigidMotion<dim> motion_of(const std::map<std::string, BodyCycle<dim>>& motions,
                           const std::string& body) {
  const auto found = motions.find(body);
  return found == motions.end() ? RigidMotion<dim>{} : found->second.motion;
}

/// Where a pair does not slide, or moves towards each other.
template <int dim>
std::vector<std::string> remarks_on_sliding(const MortarPair<dim>& pair, double speed) {
  constexpr double along = 1e-3;
  const Vector<dim>& v = pair.motion.velocity;
  const std::string names = fmt::format("\"{}\" and \"{}\"", pair.bodies[0], pair.bodies[1]);
  if (speed == 0) return {names + " do not slide on each other ([[motion]]): nothing wears there"};
  const Vector<dim> across = v - v.dot(pair.approach) * pair.approach;
  if (pair.motion.spin.isZero(0) && pair.motion.across == 0 && pair.motion.across_by_x.isZero(0) &&
      v.norm() > 0 && across.norm() < along * v.norm())
    return {names + " move towards each other, and hardly slide ([[motion]])"};
  return {};
}

/// Each of two surfaces that touch and are of one body, or of bonded ones, is a group of its own.
template <int dim>
std::array<Facets<dim>, 2> surfaces_of_one(const Scene& scene, const std::string& pair,
                                           const ImportedBody<dim>& part) {
  const std::string key = pair + ".surfaces";
  const std::vector<std::string>& names = scene.texts(key);
  if (names.size() != 2)
    refuse(scene, key,
           "two groups, one for each of the surfaces that touch, because they belong to one body "
           "or to bonded ones");
  std::array<Facets<dim>, 2> result;
  std::array<std::set<int>, 2> nodes;
  for (const std::size_t side : {0, 1}) {
    result[side] = group_facets(scene, key, names[side], part);
    for (const auto& facet : result[side]) nodes[side].insert(facet.begin(), facet.end());
  }
  for (const int node : nodes[0])
    if (nodes[1].contains(node))
      throw InputError(
          fmt::format("{}: expected surfaces that share no node, but \"{}\" and \"{}\" share the "
                      "one at ({:.6g})",
                      scene.where(key), names[0], names[1],
                      fmt::join(part.mesh.nodes[static_cast<std::size_t>(node)], ", ")));
  return result;
}

/// Both sides of a pair, before what does not face the other one is left out.
template <int dim>
std::array<Facets<dim>, 2> sides_of(const Scene& scene, const std::string& table,
                                    const ImportedBody<dim>& part, const AssemblyParts<dim>& parts,
                                    const BodyOfFacets<dim>& body_of, const Facets<dim>& wearing,
                                    const std::array<int, 2>& bodies) {
  const std::vector<int> connected = connected_parts(parts.mesh, parts.bodies);
  if (connected[bodies[0]] != connected[bodies[1]])
    return {boundary_of(scene, table, part, body_of, wearing, bodies[0]),
            boundary_of(scene, table, part, body_of, wearing, bodies[1])};
  if (scene.given(table + ".surfaces")) return surfaces_of_one(scene, table, part);
  throw InputError(fmt::format(
      "{}: expected bodies that share no node, but \"{}\" and \"{}\" are bonded: mesh "
      "each by itself, without fragments or coherence, or name the two groups that "
      "touch in pair.surfaces",
      scene.where(table + ".bodies"), parts.bodies[bodies[0]].name, parts.bodies[bodies[1]].name));
}

}  // namespace

template <int dim>
void read_pairs(const Scene& scene, const ImportedBody<dim>& part, AssemblyParts<dim>& parts) {
  const BodyOfFacets<dim> body_of(parts.mesh, parts.bodies);
  const Facets<dim> wearing = facets_of(wearing_surfaces(scene, part));
  require_moving_pairs(scene, parts);
  const std::map<std::string, BodyCycle<dim>> motions = read_motions_of_bodies(scene, parts);
  read_cycle_of_bodies(scene, motions, parts);
  const auto instants = close_places_over_cycle(parts);
  const auto carried = carried_meshes(parts, scene.real("time.end"));
  for (const std::string& table : pair_tables(scene)) {
    const std::array<int, 2> bodies = bodies_of_pair(scene, table, parts.bodies);
    const auto [slave, master] = sides_of(scene, table, part, parts, body_of, wearing, bodies);
    const std::array<std::string, 2> names = {parts.bodies[bodies[0]].name,
                                              parts.bodies[bodies[1]].name};
    MortarPair<dim> pair{
        .slave = slave,
        .master = master,
        .motion = relative_motion(motion_of(motions, names[0]), motion_of(motions, names[1])),
        .spins = {motion_of(motions, names[0]).spin, motion_of(motions, names[1]).spin},
        .friction = scene.given(table + ".friction") ? scene.real(table + ".friction")
                                                     : scene.real("friction.coefficient"),
        .bodies = names,
        .numbers = bodies};
    pair.reach = Box<dim>::around(parts.mesh.nodes).diagonal();
    pair.boundary = {pair.slave, pair.master};
    std::vector<std::vector<Vector<dim>>> x;
    for (const auto& places : instants)
      for (const std::vector<Vector<dim>>& nodes : carried)
        x.push_back(in_space<dim>({pair}, places, nodes));
    keep_facing_at<dim>(x, parts.section(), pair);
    if (pair.slave.empty()) refuse_facing(scene, table, part, body_of, pair, x);
    pair.approach = approach_of(pair, parts, bodies);
    parts.pairs.push_back(std::move(pair));
  }
  parts.interface.partner.approach = parts.pairs.front().approach;
  parts.interface.friction = parts.pairs.front().friction;
  parts.interface.surfaces = surfaces_of(scene, part, parts.pairs);
  parts.interface.speed = scene.real_if("wear.velocity");
  read_phases_of_pairs(scene, parts);
  if (parts.interface.sticks && !parts.cycle) let_roll(scene, parts);
  std::vector<double> speeds;
  for (const MortarPair<dim>& pair : parts.pairs) {
    speeds.push_back(mean_sliding_speed(parts, pair));
    if (!parts.interface.sticks && !parts.interface.rolling)
      for (std::string& remark : remarks_on_sliding(pair, speeds.back()))
        parts.remarks.push_back(std::move(remark));
  }
  if (parts.interface.speed) return;
  parts.interface.speed = *std::ranges::max_element(speeds);
  for (std::size_t k = 0; k < speeds.size() && *parts.interface.speed > 0; ++k)
    parts.pairs[k].slides = speeds[k] / *parts.interface.speed;
}

template void read_pairs(const Scene&, const ImportedBody<2>&, AssemblyParts<2>&);
template void read_pairs(const Scene&, const ImportedBody<3>&, AssemblyParts<3>&);

}  // namespace gnomon::part
