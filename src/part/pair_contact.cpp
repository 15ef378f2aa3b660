// What of the boundary of pairs can touch in a run, and which of the bodies are slaves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesh/facet_table.hpp"
#include "model/bring_together.hpp"
#include "model/rigid_balance.hpp"
#include "model/rigid_parts.hpp"
#include "part/boundary_beside.hpp"
#include "part/carried_bodies.hpp"
#include "part/changing_friction.hpp"
#include "part/facing_facets.hpp"
#include "part/groups.hpp"
#include "part/pair_cycle.hpp"
#include "part/pair_remarks.hpp"
#include "part/pairs.hpp"
#include "part/rolling_scene.hpp"
#include "part/round_fit.hpp"
#include "part/surfaces.hpp"
#include "part/tracks.hpp"

namespace gnomon::part {

template <int dim>
std::vector<Surface<dim>> surfaces_of(const Scene& scene, const ImportedBody<dim>& part,
                                      const std::vector<MortarPair<dim>>& pairs) {
  std::map<typename Mesh<dim>::Facet, typename Mesh<dim>::Facet> touching;  // by sorted nodes
  for (const MortarPair<dim>& pair : pairs)
    for (const auto* side : {&pair.slave, &pair.master})
      for (const auto& facet : *side) touching.try_emplace(sorted(facet), facet);
  std::vector<Surface<dim>> surfaces = wearing_surfaces(scene, part);
  for (Surface<dim>& surface : surfaces) {
    Facets<dim> touches;
    std::ranges::copy_if(surface.facets, std::back_inserter(touches),
                         [&](const auto& facet) { return touching.erase(sorted(facet)) > 0; });
    if (touches.empty())
      throw InputError(
          fmt::format("{}: expected surfaces that touch another body, \"{}\" faces none",
                      scene.where("wear.on"), surface.name));
    // A track wears alike all along, also where nothing can touch it.
    if (!is_track(scene, surface.name)) surface.facets = std::move(touches);
  }
  Surface<dim> others{.name = "", .facets = {}, .wear = {}, .wears = false};
  for (const auto& [nodes, facet] : touching) others.facets.push_back(facet);
  if (!others.facets.empty()) surfaces.push_back(std::move(others));
  return surfaces;
}

namespace {

/// How far the bodies are apart where nothing but supports moves them.
template <int dim>
double gap_of(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x) {
  const double travel = travel_to_touch<dim>(pair, pair.approach, x);
  return std::isfinite(travel) ? std::max(0.0, travel) : 0;
}

/// How deep bodies that supports or springs hold lie in each other at most: what contact alone
/// holds would be lost where a load ramp sets it apart [length].
template <int dim>
double interference_of(const AssemblyParts<dim>& parts, const MortarPair<dim>& pair,
                       const std::vector<std::vector<BodyPlace<dim>>>& instants) {
  double deepest = 0;
  for (const auto& places : instants)
    deepest = std::max(deepest,
                       deepest_overlap<dim>(pair, in_space(parts.pairs, places, parts.mesh.nodes),
                                            parts.section(), pair.reach));
  if (deepest == 0) return 0;
  for (const RigidPart<dim>& body : rigid_parts(parts, parts.mesh.nodes))
    if (body.loose.cols() > 0 &&
        (body.has(pair.slave.front()[0]) || body.has(pair.master.front()[0])))
      return 0;
  return deepest;
}

/// A node carries one multiplier: it is a slave in one pair. Tells why where it changes a slave.
template <int dim>
void tell_slaves_apart(const Scene& scene, std::vector<MortarPair<dim>>& pairs,
                       std::vector<std::string>& reasons) {
  std::set<int> taken;
  const auto is_free = [&](const MortarPair<dim>& pair) {
    return std::ranges::none_of(nodes_of_facets(pair.slave),
                                [&](int node) { return taken.contains(node); });
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    MortarPair<dim>& pair = pairs[k];
    if (!is_free(pair)) {
      reverse(pair);
      reasons[k] = "nodes of the other one carry those of another contact";
    }
    if (!is_free(pair))
      throw InputError(fmt::format(
          "{}: [[pair]]: expected pairs whose contacts do not meet, but that of \"{}\" and \"{}\" "
          "meets those of others on both bodies; pair.#.surfaces restricts them",
          scene.path().string(), pair.bodies[0], pair.bodies[1]));
    taken.merge(nodes_of_facets(pair.slave));
  }
}

/// Slip is that of the slave's nodes while they are covered: the slave is the surface that the
/// other one covers over the cycle, if one of them is clearly smaller. Returns why, or nothing.
template <int dim>
std::string choose_covered(const AssemblyParts<dim>& parts, MortarPair<dim>& pair) {
  constexpr double clearly = 0.95;
  const auto area = [&](const auto& facets) {
    double sum = 0;
    for (const auto& patch : contact_patches<dim>(parts.mesh, facets, {}, parts.section()))
      sum += patch.initial_area;
    return sum;
  };
  const double slave = area(pair.slave), master = area(pair.master);
  if (std::min(slave, master) > clearly * std::max(slave, master)) return "";
  if (slave > master) reverse(pair);
  return "it is the smaller surface, which stays covered";
}

/// Of bodies that roll, material comes to the nodes of the slave along the lines of its track.
/// Returns whether this changes the slave.
template <int dim>
bool choose_track(const Scene& scene, const AssemblyParts<dim>& parts, MortarPair<dim>& pair) {
  std::set<typename Mesh<dim>::Facet> on_tracks;  // by sorted nodes
  for (const Surface<dim>& surface : parts.interface.surfaces)
    for (const auto& facet : surface.facets)
      if (surface.track) on_tracks.insert(sorted(facet));
  const auto has = [&](const auto& facets) {
    return std::ranges::any_of(
        facets, [&](const auto& facet) { return on_tracks.contains(sorted(facet)); });
  };
  // That which is curved along the lines: its material follows them (passage_of()).
  const auto bend = [&](std::size_t side, const auto& facets) {
    const Vector<dim> along = pair.velocities[side].normalized();
    double most = 0;
    for (const auto& facet : facets)
      most = std::max(most, std::abs(facet_normal<dim>(facet, parts.mesh.nodes).dot(along)));
    return most;
  };
  constexpr double straight = 1e-6;
  const bool changes = !has(pair.slave) ||
                       (has(pair.master) && bend(1, pair.master) > bend(0, pair.slave) + straight);
  if (changes) reverse(pair);
  if (!has(pair.slave))
    throw InputError(
        fmt::format("{}: [[pair]]: expected a surface of \"{}\" or \"{}\" in wear.on "
                    "with a path, along which its material rolls",
                    scene.path().string(), pair.bodies[0], pair.bodies[1]));
  return changes;
}

/// By pair: facets, by sorted nodes, of wearing surfaces whose nodes are nearer to what the pair
/// touches than to what others do. A surface that several pairs touch is divided between them;
/// where it carries the pressures, with a facet between that belongs to none.
template <int dim>
std::vector<std::set<typename Mesh<dim>::Facet>> own_surfaces(
    const std::vector<Surface<dim>>& wearing, const std::vector<MortarPair<dim>>& pairs,
    const std::vector<Vector<dim>>& x) {
  std::vector<std::set<typename Mesh<dim>::Facet>> own(pairs.size());
  for (const Surface<dim>& surface : wearing) {
    const std::set<int> nodes = nodes_of_facets(surface.facets);
    std::vector<std::pair<std::size_t, std::vector<int>>> touched;  // by pair that touches it
    bool carries = false;                                           // as a slave of some pair
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      std::set<int> of_pair = nodes_of_facets(pairs[k].slave);
      carries =
          carries || std::ranges::any_of(of_pair, [&](int node) { return nodes.contains(node); });
      of_pair.merge(nodes_of_facets(pairs[k].master));
      std::vector<int> common;
      std::ranges::set_intersection(nodes, of_pair, std::back_inserter(common));
      if (!common.empty()) touched.emplace_back(k, std::move(common));
    }
    if (touched.empty()) continue;
    const auto nearest = [&](int node) {
      const auto away = [&](const auto& of) {
        double least = std::numeric_limits<double>::infinity();
        for (const int other : of.second) least = std::min(least, (x[node] - x[other]).norm());
        return least;
      };
      return std::ranges::min_element(touched, {}, away)->first;
    };
    std::map<int, std::size_t> owner;
    for (const int node : nodes)
      owner[node] = touched.size() == 1 ? touched.front().first : nearest(node);
    for (const auto& facet : surface.facets) {
      const std::size_t pair = owner.at(facet.front());
      // A node carries the pressures of one pair.
      if (!carries || std::ranges::all_of(facet, [&](int node) { return owner.at(node) == pair; }))
        own[pair].insert(sorted(facet));
    }
  }
  return own;
}

}  // namespace

template <int dim>
void restrict_pairs(const Scene& scene, const ImportedBody<dim>& part, const Magnitudes& expected,
                    AssemblyParts<dim>& parts) {
  // Contact grows to where the gap at first touch is what wear and deformation close.
  const double closed = 3 * (expected.deepest + expected.scales.displacement);
  const auto instants = places_over_cycle(parts);
  std::vector<std::vector<Vector<dim>>> touching;  // in space; first those that nothing carries
  AssemblyParts<dim> carried = parts;
  for (std::vector<Vector<dim>>& nodes : carried_meshes(parts, scene.real("time.end"))) {
    carried.mesh.nodes = std::move(nodes);
    for (const auto& places : instants)
      touching.push_back(in_space(parts.pairs, places, RigidBalance<dim>(carried, places).x));
  }
  std::vector<std::string> reasons;
  std::vector<std::vector<Vector<dim>>> nearest, meshed;  // by pair; as loads move bodies, or not
  for (MortarPair<dim>& pair : parts.pairs) {
    // Facets of a shaft and its bore have gaps of their own.
    std::vector<double> gaps;
    for (std::size_t k = 0; k < instants.size(); ++k) gaps.push_back(gap_of(pair, touching[k]));
    const auto least = std::ranges::min_element(gaps);
    const double gap = *least;
    const auto when = static_cast<std::size_t>(least - gaps.begin());
    nearest.push_back(touching[when]);
    meshed.push_back(in_space(parts.pairs, instants[when], parts.mesh.nodes));
    pair.reach = closed + gap + mean_size<dim>(pair.slave, nearest.back()) / 2;
    keep_facing_at<dim>(touching, parts.section(), pair);
    if (pair.slave.empty())
      throw InputError(fmt::format(
          "{}: [[pair]]: expected bodies that meet, but \"{}\" and \"{}\" are {:.3g} mm apart, and "
          "loads and supports bring them nearer by about {:.3g} mm",
          scene.path().string(), pair.bodies[0], pair.bodies[1], gap, closed / 3));
    std::string reason = parts.interface.sticks ? choose_covered(parts, pair) : "";
    if (reason.empty())
      reason = choose_slave<dim>(nearest.back(), parts.section(), parts.bodies, pair);
    if (parts.interface.rolling && choose_track(scene, parts, pair))
      reason = "its material rolls along a path";
    reasons.push_back(std::move(reason));
  }
  const std::vector<std::set<typename Mesh<dim>::Facet>> own =
      own_surfaces(wearing_surfaces(scene, part), parts.pairs, parts.mesh.nodes);
  for (std::size_t k = 0; k < parts.pairs.size(); ++k) {
    MortarPair<dim>& pair = parts.pairs[k];
    join_beside<dim>(nearest[k], pair,
                     [&](const auto& facet) { return own[k].contains(sorted(facet)); });
    pair.reach = 2 * (pair.reach + mean_size<dim>(pair.slave, nearest[k]));
    pair.interference = interference_of(parts, pair, instants);
  }
  tell_slaves_apart(scene, parts.pairs, reasons);
  for (std::size_t k = 0; k < reasons.size(); ++k)
    parts.remarks.push_back(
        fmt::format("\"{}\" may touch \"{}\" with {} facets, which carry the pressures since {}",
                    parts.pairs[k].bodies[0], parts.pairs[k].bodies[1], parts.pairs[k].slave.size(),
                    reasons[k]));
  tell_round_fits(part, meshed, parts);
  if (parts.interface.rolling) parts.interface.rolling = rolling_of(scene, parts);
  parts.interface.partner.approach = parts.pairs.front().approach;
  std::vector<Surface<dim>> surfaces = surfaces_of(scene, part, parts.pairs);
  for (Surface<dim>& surface : surfaces)
    for (const Surface<dim>& before : parts.interface.surfaces)
      if (before.wears && before.name == surface.name)
        surface.wear = before.wear, surface.track = before.track;
  parts.interface.surfaces = std::move(surfaces);
  tell_of_edges(parts);
  tell_of_turning(parts);
  tell_of_unworn_friction(scene, parts);
}

namespace {

/// Whether a surface is smooth over a support in direction i, as over a plane of symmetry: its
/// normal turns to the support. A flat one that is inclined has an edge there.
template <int dim>
bool is_smooth_over(int i, const ContactPatch<dim>& patch, const NodalFlags<dim>& held,
                    const std::map<int, Vector<dim>>& normals) {
  constexpr double rounding = 1e-9, turned = 0.9;
  double beside = 0;
  int count = 0;
  for (const int node : patch.nodes)
    if (const auto found = normals.find(node); found != normals.end() && !held(node, i))
      beside += std::abs(found->second[i]), ++count;
  const double own = std::abs(patch.initial_normal[i]);
  return own < rounding || own * count < turned * beside;
}

}  // namespace

template <int dim>
void keep_normals_to_supports(AssemblyParts<dim>& parts) {
  constexpr double nearly = 0.9;
  const auto& held = parts.supports.held;
  for (MortarPair<dim>& pair : parts.pairs) {
    const auto patches = contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section());
    std::map<int, Vector<dim>> normals;
    for (const auto& patch : patches) normals[patch.node] = patch.initial_normal;
    for (const auto& patch : patches) {
      Tensor<dim> free = Tensor<dim>::Identity();
      for (int i = 0; i < dim; ++i)
        if (held(patch.node, i) && is_smooth_over<dim>(i, patch, held, normals)) free(i, i) = 0;
      // Else it is no symmetry.
      if (!free.isIdentity() && (free * patch.initial_normal).norm() > nearly)
        pair.along[patch.node] = free;
    }
  }
}

template std::vector<Surface<2>> surfaces_of(const Scene&, const ImportedBody<2>&,
                                             const std::vector<MortarPair<2>>&);
template std::vector<Surface<3>> surfaces_of(const Scene&, const ImportedBody<3>&,
                                             const std::vector<MortarPair<3>>&);
template void restrict_pairs(const Scene&, const ImportedBody<2>&, const Magnitudes&,
                             AssemblyParts<2>&);
template void restrict_pairs(const Scene&, const ImportedBody<3>&, const Magnitudes&,
                             AssemblyParts<3>&);
template void keep_normals_to_supports(AssemblyParts<2>&);
template void keep_normals_to_supports(AssemblyParts<3>&);

}  // namespace gnomon::part
