// What presses the bodies on each other: forces, or displacements that are given.
#include <algorithm>
#include <cmath>
#include <gnomon/model/magnitudes.hpp>

#include "model/bring_together.hpp"
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
double load_along_approach(const AssemblyParts<dim>& parts) {
  constexpr double rounding = 1e-12;
  std::vector<double> along;
  for (const Load<dim>& load : parts.loads)
    along.push_back(resultant(load, parts).dot(parts.interface.partner.approach));
  const auto sum = [&](auto factor) {
    double net = 0, whole = 0;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const double force = factor(parts.loads[k].history) * along[k];
      net += force;
      whole += std::abs(force);
    }
    if (std::abs(net) > rounding * whole) return std::abs(net);
    return parts.pairs.empty() ? 0 : whole / 2;
  };
  double most = sum([](const LoadHistory&) { return 1.0; });
  if (most > 0) return most;
  for (const Load<dim>& load : parts.loads)
    for (const double t : load.history.times())
      most = std::max(most, sum([t](const LoadHistory& history) { return history.factor(t); }));
  return most;
}

/// All loads, without regard to their directions, of pairs with a body that may turn: those across
/// the approach press by their torques. Their levers are not known here.
template <int dim>
double load_on_levers(const AssemblyParts<dim>& parts) {
  constexpr double rounding = 1e-6;
  if (parts.pairs.empty()) return 0;
  const bool turns =
      std::ranges::any_of(rigid_parts(parts, parts.mesh.nodes), [](const RigidPart<dim>& part) {
        return part.loose.bottomRows(rigid_motions_of(dim) - dim).norm() > rounding;
      });
  double whole = 0;
  for (const Load<dim>& load : parts.loads)
    whole += load.forces.size() > 0
                 ? load.forces.rowwise().norm().sum()  // a moment has no resultant
                 : resultant(load, parts).norm();
  return turns ? whole : 0;
}

/// Of all springs whose other ends move, at most: of unlike directions more than there is.
template <int dim>
double force_of_springs(const AssemblyParts<dim>& parts) {
  double sum = 0;
  for (const SpringSupport<dim>& springs : parts.supports.springs) {
    const double traction =
        springs.stiffness.cwiseProduct(springs.displacement).norm() * springs.history.largest();
    for (const auto& patch : contact_patches<dim>(parts.mesh, springs.facets, {}, parts.section()))
      sum += traction * patch.initial_area;
  }
  return sum;
}

/// How far the bodies are brought into each other where no force presses them.
template <int dim>
double given_overlap(const AssemblyParts<dim>& parts) {
  double most = 0;
  const auto take = [&](const LoadHistory& history, double value) {
    most = std::max(most, std::abs(value) * history.largest());
  };
  for (const PrescribedValues& held : parts.supports.moved)
    for (const auto& entry : held.entries) take(held.history, entry.value);
  for (const Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.travel) take(*guide.travel, 1);
  if (!parts.pairs.empty()) {
    for (const Phase<dim>& phase : parts.instants()) {
      const auto x = in_space(parts.pairs, phase.places, parts.mesh.nodes);
      for (const MortarPair<dim>& pair : parts.pairs)
        most = std::max(most, -travel_to_touch<dim>(pair, pair.approach, x));
    }
    return most;
  }
  return std::max(most, overlap_at_rest(contact_nodes_of(parts), parts.interface.partner));
}

}  // namespace

template <int dim>
double overlap_at_rest(const std::vector<ContactPatch<dim>>& nodes, const CounterBody<dim>& other) {
  PartnerMotion<> q = other.given(0, 0);
  q.setZero();
  double deepest = 0;
  for (const ContactPatch<dim>& patch : nodes)
    deepest = std::max(deepest, -other.unchecked_distance(patch.initial_position, q, 0).gap);
  return deepest;
}

template <int dim>
Pressing pressing_of(const AssemblyParts<dim>& parts, double duration) {
  const Interface<dim>& interface = parts.interface;
  constexpr double across = 0.1;
  double most_load = 0;
  for (const Phase<dim>& phase : parts.instants()) most_load = std::max(most_load, phase.load);
  double force = interface.force ? *interface.force / interface.partner.guides.front().share
                                 : most_load * load_along_approach(parts);
  Pressing press{.overlap = given_overlap(parts)};
  double moved = 0;
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    moved = std::max(moved, springs.displacement.cwiseAbs().maxCoeff() * springs.history.largest());
  if (moved > press.overlap) {
    press.overlap = moved;
    press.springs = force_of_springs(parts);
  }
  if (const double levers = most_load * load_on_levers(parts); force < across * levers)
    force = levers;
  press.force = force;
  press.impulse = force * interface.history.integral(duration);
  return press;
}

template double overlap_at_rest(const std::vector<ContactPatch<2>>&, const CounterBody<2>&);
template double overlap_at_rest(const std::vector<ContactPatch<3>>&, const CounterBody<3>&);
template Pressing pressing_of(const AssemblyParts<2>&, double);
template Pressing pressing_of(const AssemblyParts<3>&, double);

}  // namespace gnomon
