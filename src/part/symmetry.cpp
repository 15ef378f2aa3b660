#include "part/symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/expected_contact.hpp"

namespace gnomon::part {

namespace {

/// x_axis = place, with the nodes of the contact on it, all others beyond on one side.
struct CutPlane {
  std::string support;
  int axis = 0;
  double place = 0;  ///< [length]
  std::vector<int> nodes;
};

/// Planes of the supports that hold nodes of these in one direction alone.
template <int dim>
std::vector<CutPlane> cut_planes(const AssemblyParts<dim>& parts, const std::set<int>& contact) {
  const auto& X = parts.mesh.nodes;
  const auto at = [&](int node, int axis) { return X[static_cast<std::size_t>(node)][axis]; };
  std::vector<CutPlane> result;
  for (const NamedSupport& support : parts.supports.named)
    for (int axis = 0; axis < dim; ++axis) {
      CutPlane plane{support.name, axis, 0, {}};
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const auto& [node, direction] : support.held) {
        if (direction != axis) continue;
        least = std::min(least, at(node, axis)), most = std::max(most, at(node, axis));
        if (contact.contains(node) && parts.supports.held.row(node).template cast<int>().sum() == 1)
          plane.nodes.push_back(node);
      }
      const auto [low, high] =
          std::ranges::minmax(contact, {}, [&](int node) { return at(node, axis); });
      const double rounding = 1e-6 * (at(high, axis) - at(low, axis));
      plane.place = least;
      const bool ends = least <= at(low, axis) + rounding || most >= at(high, axis) - rounding;
      if (!plane.nodes.empty() && most - least <= rounding && ends) result.push_back(plane);
    }
  return result;
}

/// Leaves the nodes of the planes where contact may be within `reach` of where it is first.
template <int dim>
void keep_reached(const AssemblyParts<dim>& parts, double reach, std::vector<CutPlane>& planes) {
  if (planes.empty()) return;
  const std::map<int, double> gaps = gaps_over_cycle(parts, true);
  double first = std::numeric_limits<double>::infinity();
  for (const auto& [node, gap] : gaps) first = std::min(first, gap);
  for (CutPlane& plane : planes)
    std::erase_if(plane.nodes, [&](int node) {
      const auto found = gaps.find(node);
      return found == gaps.end() || !(found->second - first <= reach);
    });
}

/// The part of a vector along an axis.
template <int dim>
double part_along(const Vector<dim>& v, int axis, double beside = 0) {
  const double whole = std::hypot(v.norm(), beside);
  return whole > 0 ? std::abs(v[axis]) / whole : 0;
}

/// Of steady rolling.
template <int dim>
double rolls_across(const Rolling<dim>& rolling, const Vector<dim>& x, int axis) {
  // Also by none: half of the contact alone would have it.
  const bool driven = rolling.force[static_cast<std::size_t>(axis)] || rolling.moment;
  return std::max({driven ? 1.0 : 0.0, part_along<dim>(rolling.velocity, axis),
                   part_along<dim>(rolling.creepage_at(x), axis)});
}

/// Of a pair in one phase, and since the first phase of a path.
template <int dim>
double slides_across(const MortarPair<dim>& pair, const Phase<dim>& phase, const Phase<dim>& first,
                     bool sticks, const Vector<dim>& x, int axis) {
  const PairPlaces<dim> now(pair, phase.places), before(pair, first.places);
  const auto apart = [&](const PairPlaces<dim>& at) {
    return Vector<dim>(at.of[1].of(x) - at.of[0].of(x));
  };
  const double moves = part_along<dim>(now.motion.at(x), axis, now.motion.across_at(x));
  return sticks ? std::max(moves, part_along<dim>(apart(now) - apart(before), axis)) : moves;
}

/// The same of a counter-body, which forces along its further guides move, too.
template <int dim>
double slides_across(const Interface<dim>& interface, const Phase<dim>& phase,
                     const Phase<dim>& first, const Vector<dim>& x, int axis) {
  const CounterBody<dim>& other = phase.counter_body;
  double most =
      part_along<dim>(other.motion.at(x) - interface.streaming, axis, other.motion.across_at(x));
  if (interface.sticks)
    most = std::max(most, part_along<dim>(other.position - first.counter_body.position, axis));
  for (std::size_t k = 1; k < other.guides.size(); ++k)
    if (other.guides[k].force.value_or(0) != 0)
      most = std::max(most, std::abs(other.guides[k].along[axis]));
  return most;
}

/// The part across the plane of what moves or drives the partners that rub on a node of it.
template <int dim>
double across(const AssemblyParts<dim>& parts, int node, int axis) {
  const Interface<dim>& interface = parts.interface;
  const std::vector<Phase<dim>> phases = parts.instants();
  const Vector<dim>& x = parts.mesh.nodes[static_cast<std::size_t>(node)];
  double most = 0;
  for (const MortarPair<dim>& pair : parts.pairs) {
    if (pair.friction == 0) continue;
    if (!nodes_of_facets(pair.slave).contains(node) && !nodes_of_facets(pair.master).contains(node))
      continue;
    if (interface.rolling) return rolls_across(*interface.rolling, x, axis);
    for (const Phase<dim>& phase : phases)
      most = std::max(most, slides_across(pair, phase, phases.front(), interface.sticks, x, axis));
  }
  if (!parts.pairs.empty() || interface.friction == 0) return most;
  if (interface.rolling) return rolls_across(*interface.rolling, x, axis);
  for (const Phase<dim>& phase : phases)
    most = std::max(most, slides_across(interface, phase, phases.front(), x, axis));
  return most;
}

}  // namespace

template <int dim>
std::vector<std::string> remarks_on_symmetry(const AssemblyParts<dim>& parts,
                                             const Magnitudes& expected) {
  constexpr double little = 1e-6;  // of what rounding leaves across
  if (parts.section() == Section::meridian) return {};
  std::vector<CutPlane> planes =
      cut_planes(parts, nodes_of_facets(facets_of(parts.interface.surfaces)));
  keep_reached(parts, 1.5 * (expected.deepest + expected.scales.displacement), planes);
  std::vector<std::string> remarks;
  for (const CutPlane& plane : planes) {
    double part = 0;
    for (const int node : plane.nodes) part = std::max(part, across(parts, node, plane.axis));
    if (part <= little) continue;
    const char axis = "xyz"[plane.axis];
    remarks.push_back(fmt::format(
        "{} holds {} where the contact ends, at {} = {:.4g} mm, and {:.3g} % of the partner's "
        "motion or force is along {}: right for a stop, but if it stands for a plane of "
        "symmetry, friction across it has no mirror image, and the whole body is needed",
        plane.support, axis, axis, plane.place, 100 * part, axis));
  }
  return remarks;
}

template std::vector<std::string> remarks_on_symmetry(const AssemblyParts<2>&, const Magnitudes&);
template std::vector<std::string> remarks_on_symmetry(const AssemblyParts<3>&, const Magnitudes&);

}  // namespace gnomon::part
