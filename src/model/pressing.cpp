// What presses the bodies on each other: forces, or displacements that are given.
#include <algorithm>
#include <cmath>
#include <gnomon/model/magnitudes.hpp>

#include "model/bring_together.hpp"
#include "model/facet_gaps.hpp"
#include "model/rigid_parts.hpp"

namespace gnomon {

namespace {

template <int dim>
Vector<dim> resultant(const Load<dim>& load, const AssemblyParts<dim>& parts) {
  return forces_of(load, parts).colwise().sum().transpose();
}

/// All loads together along the approach of the counter-body, at factor one, or, where they cancel
/// each other then, the largest of their history; of pairs that loads press from both sides, half
/// of the sum of their sizes.
template <int dim>
double load_along_approach(const AssemblyParts<dim>& parts, const std::vector<Load<dim>>& loads) {
  constexpr double rounding = 1e-12;
  std::vector<double> along;
  for (const Load<dim>& load : loads)
    along.push_back(resultant(load, parts).dot(parts.interface.partner.approach));
  const auto sum = [&](auto factor) {
    double net = 0, whole = 0;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const double force = factor(loads[k].history) * along[k];
      net += force;
      whole += std::abs(force);
    }
    if (std::abs(net) > rounding * whole) return std::abs(net);
    return parts.pairs.empty() ? 0 : whole / 2;
  };
  double most = sum([](const LoadHistory&) { return 1.0; });
  if (most > 0) return most;
  for (const Load<dim>& load : loads)
    for (const double t : load.history.times())
      most = std::max(most, sum([t](const LoadHistory& history) { return history.factor(t); }));
  return most;
}

/// All loads, without regard to their directions, of pairs with a body that may turn: those across
/// the approach press by their torques. Their levers are not known here.
template <int dim>
double load_on_levers(const AssemblyParts<dim>& parts, const std::vector<Load<dim>>& loads,
                      SpringsHold springs) {
  constexpr double rounding = 1e-6;
  if (parts.pairs.empty()) return 0;
  const bool turns = std::ranges::any_of(
      rigid_parts(parts, parts.mesh.nodes, springs), [](const RigidPart<dim>& part) {
        return part.loose.bottomRows(rigid_motions_of(dim) - dim).norm() > rounding;
      });
  double whole = 0;
  for (const Load<dim>& load : loads)
    whole += load.forces.size() > 0
                 ? load.forces.rowwise().norm().sum()  // a moment has no resultant
                 : resultant(load, parts).norm();
  return turns ? whole : 0;
}

/// What presses bodies of these loads.
template <int dim>
double force_of(const AssemblyParts<dim>& parts, const std::vector<Load<dim>>& loads,
                SpringsHold springs) {
  constexpr double across = 0.1;
  const double along = load_along_approach(parts, loads),
               levers = load_on_levers(parts, loads, springs);
  return along < across * levers ? levers : along;
}

/// How far the other ends of springs move, at most.
template <int dim>
double moved_by_springs(const AssemblyParts<dim>& parts) {
  double most = 0;
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    most = std::max(most, springs.displacement.cwiseAbs().maxCoeff() * springs.history.largest());
  return most;
}

/// Of all springs whose other ends move, at most: of unlike directions more than there is.
template <int dim>
double all_of_springs(const AssemblyParts<dim>& parts) {
  double sum = 0;
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    sum += pull_of(springs, parts).rowwise().norm().sum() * springs.history.largest();
  return sum;
}

/// Whether one of the bodies rests on what it touches by nothing but such springs.
template <int dim>
bool rests_by_springs(const AssemblyParts<dim>& parts) {
  for (const RigidPart<dim>& part : rigid_parts(parts, parts.mesh.nodes, SpringsHold::no))
    for (const SpringSupport<dim>& springs : parts.supports.springs)
      if (part.loose.cols() > 0 && !springs.displacement.isZero(0) &&
          part.has(springs.facets.front()[0]))
        return true;
  return false;
}

/// What they press like loads.
template <int dim>
double force_of_springs(const AssemblyParts<dim>& parts) {
  std::vector<Load<dim>> pulls;
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    pulls.push_back({.forces = springs.history.largest() * pull_of(springs, parts)});
  return force_of(parts, pulls, SpringsHold::no);
}

/// How far the bodies are brought into each other where no force presses them.
template <int dim>
double given_overlap(const AssemblyParts<dim>& parts) {
  constexpr double above = 1.001;  // for rounding
  double most = 0;
  const auto take = [&](const LoadHistory& history, double value) {
    most = std::max(most, std::abs(value) * history.largest());
  };
  for (const PrescribedValues& held : parts.supports.moved)
    for (const auto& entry : held.entries) take(held.history, entry.value);
  for (const Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.travel) take(*guide.travel, 1);
  if (parts.pairs.empty()) {
    const auto nodes = contact_nodes_of(parts);
    for (const Phase<dim>& phase : parts.instants())
      most = std::max(most, overlap_at_rest(nodes, phase.counter_body));
    return most;
  }
  for (const Phase<dim>& phase : parts.instants()) {
    const auto x = in_space(parts.pairs, phase.places, parts.mesh.nodes);
    for (const MortarPair<dim>& pair : parts.pairs) {
      // Along the approach a shaft lies deeper in its hub, at the sides, than along the normals.
      const double along = -travel_to_touch<dim>(pair, pair.approach, x);
      if (!(along > most)) continue;
      const double across = deepest_overlap(pair, x, parts.section(), above * along);
      most = std::max(most, across > 0 ? across : along);
    }
  }
  return most;
}

}  // namespace

template <int dim>
double overlap_at_rest(const std::vector<ContactPatch<dim>>& nodes, const CounterBody<dim>& other,
                       double part) {
  const PartnerMotion<> q = part * other.given(0, 0);
  double deepest = 0;
  for (const ContactPatch<dim>& patch : nodes)
    deepest = std::max(deepest, -other.unchecked_distance(patch.initial_position, q, 0).gap);
  return deepest;
}

template <int dim>
Pressing pressing_of(const AssemblyParts<dim>& parts, double duration) {
  const Interface<dim>& interface = parts.interface;
  double most_load = 0;
  for (const Phase<dim>& phase : parts.instants()) most_load = std::max(most_load, phase.load);
  double force = interface.force ? *interface.force / interface.partner.guides.front().share
                                 : most_load * force_of(parts, parts.loads, SpringsHold::yes);
  Pressing press{.overlap = given_overlap(parts)};
  const double moved = moved_by_springs(parts);
  if (moved > 0 && rests_by_springs(parts)) {
    // What overlaps, like a cam that lifts, is moved by so much against the springs.
    press.springs = all_of_springs(parts) * (1 + press.overlap / moved);
    press.overlap += moved;
    if (!interface.force && force < force_of_springs(parts)) {
      press.springs += force;
      force = 0;
    }
  } else if (moved > press.overlap) {
    press.overlap = moved;
    press.springs = all_of_springs(parts);
  }
  press.force = force;
  press.impulse = force * interface.history.integral(duration);
  return press;
}

template double overlap_at_rest(const std::vector<ContactPatch<2>>&, const CounterBody<2>&, double);
template double overlap_at_rest(const std::vector<ContactPatch<3>>&, const CounterBody<3>&, double);
template Pressing pressing_of(const AssemblyParts<2>&, double);
template Pressing pressing_of(const AssemblyParts<3>&, double);

}  // namespace gnomon
