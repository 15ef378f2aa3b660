#include "part/pair_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>

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
    motion.bodies.back().name = body.name;
  }
  parts.cycle = CyclicContact<dim>{motion, {1, {}}};
}

template <int dim>
std::vector<std::vector<BodyPlace<dim>>> places_over_cycle(const AssemblyParts<dim>& parts) {
  if (!parts.cycle) return {{}};
  std::vector<std::vector<BodyPlace<dim>>> all;
  for (const Phase<dim>& phase : parts.phases) all.push_back(phase.places);
  for (int k = 0; k < samples; ++k) {
    std::vector<BodyPlace<dim>>& places = all.emplace_back();
    for (const BodyCycle<dim>& body : parts.cycle->motion.bodies)
      places.push_back(body.at((k + 0.5) / samples));
  }
  return all;
}

template <int dim>
std::vector<RigidMotion<dim>> motions_over_cycle(const AssemblyParts<dim>& parts,
                                                 const MortarPair<dim>& pair) {
  std::vector<RigidMotion<dim>> motions;
  for (const auto& places : places_over_cycle(parts)) {
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

template <int dim>
double mean_sliding_speed(const std::vector<RigidMotion<dim>>& motions,
                          const ContactPatch<dim>& patch) {
  double speed = 0;
  for (RigidMotion<dim> at : motions) {
    at.reference = patch.initial_position;
    at.normal = patch.initial_normal;
    speed += at.nominal_speed(Vector<dim>::Zero()) / static_cast<double>(motions.size());
  }
  return speed;
}

namespace {

/// The point of a slave whose speed, in the mean over the cycle, is nearest to that of all.
template <int dim>
void choose_sliding_point(const AssemblyParts<dim>& parts, CyclicMotion<dim>& motion) {
  const MortarPair<dim>& pair = parts.pairs.front();
  const std::vector<RigidMotion<dim>> motions = motions_over_cycle(parts, pair);
  const auto patches = contact_patches<dim>(parts.mesh, pair.slave, {}, parts.section());
  std::vector<double> speeds;
  double mean = 0;
  for (const auto& patch : patches) {
    speeds.push_back(mean_sliding_speed(motions, patch));
    mean += speeds.back() / static_cast<double>(patches.size());
  }
  const auto chosen = static_cast<std::size_t>(
      std::ranges::min_element(speeds, {}, [&](double speed) { return std::abs(speed - mean); }) -
      speeds.begin());
  motion.sliding = pair.numbers;
  motion.point = patches[chosen].initial_position;
  motion.normal = patches[chosen].initial_normal;
}

}  // namespace

template <int dim>
void read_phases_of_pairs(const Scene& scene, AssemblyParts<dim>& parts) {
  if (!parts.cycle) return;
  CyclicMotion<dim> motion = parts.cycle->motion;
  choose_sliding_point(parts, motion);
  ReadPhases<dim> read = parts.interface.sticks
                             ? read_path<dim>(scene, motion, parts.interface.partner, {})
                             : read_phases<dim>(scene, motion, parts.interface.partner, {});
  parts.cycle = read.contact;
  parts.phases = std::move(read.phases);
  parts.remarks.insert(parts.remarks.end(), read.remarks.begin(), read.remarks.end());
  if (!parts.interface.speed)
    parts.interface.speed = mean_speed<dim>(motion, parts.interface.partner);
}

template void read_cycle_of_bodies(const Scene&, const std::map<std::string, BodyCycle<2>>&,
                                   AssemblyParts<2>&);
template void read_cycle_of_bodies(const Scene&, const std::map<std::string, BodyCycle<3>>&,
                                   AssemblyParts<3>&);
template void read_phases_of_pairs(const Scene&, AssemblyParts<2>&);
template void read_phases_of_pairs(const Scene&, AssemblyParts<3>&);
template std::vector<std::vector<BodyPlace<2>>> places_over_cycle(const AssemblyParts<2>&);
template std::vector<std::vector<BodyPlace<3>>> places_over_cycle(const AssemblyParts<3>&);
template double mean_sliding_speed(const std::vector<RigidMotion<2>>&, const ContactPatch<2>&);
template double mean_sliding_speed(const std::vector<RigidMotion<3>>&, const ContactPatch<3>&);
template std::vector<RigidMotion<2>> motions_over_cycle(const AssemblyParts<2>&,
                                                        const MortarPair<2>&);
template std::vector<RigidMotion<3>> motions_over_cycle(const AssemblyParts<3>&,
                                                        const MortarPair<3>&);

}  // namespace gnomon::part
