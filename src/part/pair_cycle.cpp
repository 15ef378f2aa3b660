#include "part/pair_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>
#include <map>

#include "model/bring_together.hpp"
#include "part/histories.hpp"
#include "part/part_cycle.hpp"
#include "part/phases.hpp"
#include "part/stick_path.hpp"

namespace gnomon::part {

namespace {

/// What belongs to a counter-body.
void require_cycle_of_bodies(const Scene& scene) {
  for (const char* key : {"cycle.x", "cycle.y", "cycle.z", "cycle.rotation"})
    if (scene.given(key))
      throw InputError(fmt::format("{}: expected motion.#.cycle.{} of a body beside [[pair]]",
                                   scene.where(key), std::string(key).substr(6)));
  if (scene.given("cycle.force")) refuse(scene, "cycle.force", "cycle.load beside [[pair]]");
}

}  // namespace

template <int dim>
void read_cycle_of_bodies(const Scene& scene, const std::map<std::string, BodyCycle<dim>>& motions,
                          AssemblyParts<dim>& parts) {
  require_cycle_of_bodies(scene);
  const std::optional<Cycle> cycle = read_cycle(scene);
  for (const auto& [name, motion] : motions)
    if (motion.moves() && !cycle)
      throw InputError(
          fmt::format("{}: [[motion]]: expected also [cycle] period for the cycle of "
                      "\"{}\"",
                      scene.path().string(), name));
  if (!cycle) return;
  const bool changes =
      cycle->load || !parts.swinging_loads.empty() ||
      std::ranges::any_of(motions, [](const auto& of) { return of.second.moves(); });
  if (!changes)
    refuse(scene, "cycle.period",
           "what changes over the cycle: motion.#.cycle of a body, cycle.load or load.#.cycle; a "
           "steady motion needs no [cycle]");
  CyclicMotion<dim> motion{.cycle = *cycle, .axis = {}};
  for (const Body& body : parts.bodies) {
    const auto found = motions.find(body.name);
    motion.bodies.push_back(found == motions.end() ? BodyCycle<dim>{} : found->second);
    motion.bodies.back().cycle.period = cycle->period;
  }
  parts.cycle = CyclicContact<dim>{motion, {1, {}}};
}

namespace {

/// In the middles of equal parts of the cycle.
template <int dim>
std::vector<std::vector<BodyPlace<dim>>> places_at(const CyclicMotion<dim>& motion, int count) {
  std::vector<std::vector<BodyPlace<dim>>> all;
  for (int k = 0; k < count; ++k) {
    std::vector<BodyPlace<dim>>& places = all.emplace_back();
    for (const BodyCycle<dim>& body : motion.bodies) places.push_back(body.at((k + 0.5) / count));
  }
  return all;
}

/// Around each body.
template <int dim>
std::vector<Box<dim>> boxes_of(const AssemblyParts<dim>& parts) {
  std::vector<std::vector<Vector<dim>>> x(parts.bodies.size());
  const std::vector<int> body_of = body_of_cells(parts.bodies, parts.mesh.cells.size());
  for (std::size_t cell = 0; cell < body_of.size(); ++cell)
    for (const int node : parts.mesh.cells[cell])
      x[static_cast<std::size_t>(body_of[cell])].push_back(
          parts.mesh.nodes[static_cast<std::size_t>(node)]);
  std::vector<Box<dim>> boxes;
  for (const auto& of_body : x) boxes.push_back(Box<dim>::around(of_body));
  return boxes;
}

/// At the sampled positions; one, at rest, without a cycle.
template <int dim>
std::vector<std::vector<BodyPlace<dim>>> sampled_places(const AssemblyParts<dim>& parts) {
  if (!parts.cycle) return {{}};
  return places_at(parts.cycle->motion, samples);
}

}  // namespace

template <int dim>
std::vector<std::vector<BodyPlace<dim>>> places_over_cycle(const AssemblyParts<dim>& parts) {
  std::vector<std::vector<BodyPlace<dim>>> all;
  for (const Phase<dim>& phase : parts.phases) all.push_back(phase.places);
  for (auto& places : sampled_places(parts)) all.push_back(std::move(places));
  return all;
}

template <int dim>
std::vector<std::vector<BodyPlace<dim>>> close_places_over_cycle(const AssemblyParts<dim>& parts) {
  constexpr int most = dim == 2 ? 16 : 4;  // times as many as at least
  if (!parts.cycle) return {{}};
  auto all = places_at(parts.cycle->motion, samples);
  const std::vector<Box<dim>> boxes = boxes_of(parts);
  double smallest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (std::size_t body = 0; body < boxes.size(); ++body) {
    const auto& [low, high] = boxes[body];
    smallest = std::min(smallest, (high - low).minCoeff());
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const Vector<dim>& corner : {low, high})
        farthest =
            std::max(farthest,
                     (all[k][body].of(corner) - all[(k + 1) % all.size()][body].of(corner)).norm());
  }
  const double times = std::ceil(farthest / (smallest / 2));
  if (times > 1) all = places_at(parts.cycle->motion, samples * int(std::min<double>(times, most)));
  return all;
}

namespace {

/// The motion of a pair at these places, in the frame of the slave.
template <int dim>
std::vector<RigidMotion<dim>> motions_at(const std::vector<std::vector<BodyPlace<dim>>>& sampled,
                                         const MortarPair<dim>& pair) {
  std::vector<RigidMotion<dim>> motions;
  for (const auto& places : sampled) {
    const PairPlaces<dim> at(pair, places);
    RigidMotion<dim>& motion = motions.emplace_back(at.motion);
    // In the frame of the slave.
    const Tensor<dim>& turn = at.of[0].turn;
    motion.velocity = turn.transpose() * at.motion.at(at.of[0].shift);
    motion.spin = turn.transpose() * at.motion.spin * turn;
    motion.across = at.motion.across_at(at.of[0].shift);
    motion.across_by_x = turn.transpose() * at.motion.across_by_x;
  }
  return motions;
}

/// Where the slave meets a motion of the master [length / time].
template <int dim>
double speed_at(const ContactPatch<dim>& patch, RigidMotion<dim> motion) {
  motion.reference = patch.initial_position;
  motion.normal = patch.initial_normal;
  return motion.nominal_speed(Vector<dim>::Zero());
}

/// By the shares of the nodes in the surface.
template <int dim>
double mean_speed_over(const std::vector<ContactPatch<dim>>& patches,
                       const RigidMotion<dim>& motion) {
  double sum = 0, area = 0;
  for (const ContactPatch<dim>& patch : patches) {
    sum += patch.initial_area * speed_at(patch, motion);
    area += patch.initial_area;
  }
  return area > 0 ? sum / area : 0;
}

/// The nodes of the slave to which the master comes first; all where it comes to none.
template <int dim>
std::vector<ContactPatch<dim>> met_first(const std::vector<ContactPatch<dim>>& patches,
                                         const MortarPair<dim>& pair,
                                         const std::vector<Vector<dim>>& x) {
  constexpr double rounding = 1e-6;
  const std::map<int, double> travels = travels_of_side<dim>(pair, 0, x);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [node, travel] : travels) least = std::min(least, travel);
  if (!std::isfinite(least)) return patches;
  std::vector<ContactPatch<dim>> first;
  for (const ContactPatch<dim>& patch : patches)
    if (const auto at = travels.find(patch.node);
        at != travels.end() && at->second <= least + rounding * pair.reach)
      first.push_back(patch);
  return first;
}

}  // namespace

template <int dim>
double mean_sliding_speed(const AssemblyParts<dim>& parts, const MortarPair<dim>& pair) {
  constexpr double nothing = 1e-9;
  const auto places = sampled_places(parts);
  const std::vector<RigidMotion<dim>> motions = motions_at<dim>(places, pair);
  const auto patches = contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section());
  double first = 0, all = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto x = in_space<dim>({pair}, places[k], parts.mesh.nodes);
    first += mean_speed_over(met_first(patches, pair, x), motions[k]);
    all += mean_speed_over(patches, motions[k]);
  }
  // A ball that turns about the place where it touches slides where it will touch later.
  return (first > nothing * all ? first : all) / static_cast<double>(places.size());
}

namespace {

/// The point of a slave whose speed, in the mean over the cycle, is nearest to that of the pair.
template <int dim>
void choose_sliding_point(const AssemblyParts<dim>& parts, const MortarPair<dim>& pair,
                          CyclicMotion<dim>& motion) {
  const std::vector<RigidMotion<dim>> motions = motions_at<dim>(sampled_places(parts), pair);
  const auto patches = contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section());
  const double mean = mean_sliding_speed(parts, pair);
  std::vector<double> off;
  for (const auto& patch : patches) {
    double speed = 0;
    for (const RigidMotion<dim>& at : motions) speed += speed_at(patch, at);
    off.push_back(std::abs(speed / static_cast<double>(motions.size()) - mean));
  }
  const auto chosen = static_cast<std::size_t>(std::ranges::min_element(off) - off.begin());
  motion.sliding = pair.numbers;
  motion.point = patches[chosen].initial_position;
  motion.normal = patches[chosen].initial_normal;
}

/// Where the bodies of other pairs than the first one reverse.
template <int dim>
std::vector<double> other_reversals(const AssemblyParts<dim>& parts) {
  std::vector<double> found;
  for (std::size_t k = 1; k < parts.pairs.size(); ++k) {
    CyclicMotion<dim> motion = parts.cycle->motion;
    choose_sliding_point(parts, parts.pairs[k], motion);
    found = merged_kinks(std::move(found), reversals(motion, parts.interface.partner));
  }
  return found;
}

}  // namespace

template <int dim>
void read_phases_of_pairs(const Scene& scene, AssemblyParts<dim>& parts) {
  if (!parts.cycle) return;
  CyclicMotion<dim> motion = parts.cycle->motion;
  choose_sliding_point(parts, parts.pairs.front(), motion);
  ReadPhases<dim> read =
      parts.interface.sticks
          ? read_path<dim>(scene, motion, parts.interface.partner, {})
          : read_phases<dim>(scene, motion, parts.interface.partner, {}, other_reversals(parts));
  parts.cycle = read.contact;
  parts.phases = std::move(read.phases);
  parts.remarks.insert(parts.remarks.end(), read.remarks.begin(), read.remarks.end());
}

template void read_cycle_of_bodies(const Scene&, const std::map<std::string, BodyCycle<2>>&,
                                   AssemblyParts<2>&);
template void read_cycle_of_bodies(const Scene&, const std::map<std::string, BodyCycle<3>>&,
                                   AssemblyParts<3>&);
template void read_phases_of_pairs(const Scene&, AssemblyParts<2>&);
template void read_phases_of_pairs(const Scene&, AssemblyParts<3>&);
template std::vector<std::vector<BodyPlace<2>>> places_over_cycle(const AssemblyParts<2>&);
template std::vector<std::vector<BodyPlace<3>>> places_over_cycle(const AssemblyParts<3>&);
template std::vector<std::vector<BodyPlace<2>>> close_places_over_cycle(const AssemblyParts<2>&);
template std::vector<std::vector<BodyPlace<3>>> close_places_over_cycle(const AssemblyParts<3>&);
template double mean_sliding_speed(const AssemblyParts<2>&, const MortarPair<2>&);
template double mean_sliding_speed(const AssemblyParts<3>&, const MortarPair<3>&);

}  // namespace gnomon::part
