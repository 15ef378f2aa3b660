#include "part/symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gnomon::part {

namespace {

template <int dim, class Facets>
std::set<int> nodes_of(const Facets& facets) {
  std::set<int> result;
  for (const auto& facet : facets) result.insert(facet.begin(), facet.end());
  return result;
}

/// x_axis = place, with the nodes of the contact on it, all others beyond on one side.
template <int dim>
struct CutPlane {
  std::string support;
  int axis = 0;
  double place = 0;  ///< [length]
  std::vector<int> nodes;
};

/// Planes of the supports that hold nodes of these in one direction alone.
template <int dim>
std::vector<CutPlane<dim>> cut_planes(const AssemblyParts<dim>& parts,
                                      const std::set<int>& contact) {
  const auto& X = parts.mesh.nodes;
  const auto at = [&](int node, int axis) { return X[static_cast<std::size_t>(node)][axis]; };
  std::vector<CutPlane<dim>> result;
  for (const NamedSupport& support : parts.supports.named)
    for (int axis = 0; axis < dim; ++axis) {
      CutPlane<dim> plane{support.name, axis, 0, {}};
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

/// How much farther these nodes are from the partner than the nearest ones [length].
template <int dim>
double farther(const AssemblyParts<dim>& parts, const std::set<int>& contact,
               const std::vector<int>& nodes) {
  const auto& X = parts.mesh.nodes;
  const std::vector<Phase<dim>> phases = parts.instants();
  const auto travel = [&](int node) {
    double least = std::numeric_limits<double>::infinity();
    for (const Phase<dim>& phase : phases)
      least = std::min(least, phase.counter_body.travel_to(X[static_cast<std::size_t>(node)]));
    return least;
  };
  const auto least_of = [](const auto& some, const auto& distance) {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : some) least = std::min(least, distance(node));
    return least;
  };
  if (parts.pairs.empty()) return least_of(nodes, travel) - least_of(contact, travel);
  double least = std::numeric_limits<double>::infinity();
  for (const MortarPair<dim>& pair : parts.pairs)
    for (const std::size_t side : {0u, 1u}) {
      const std::set<int> own = nodes_of<dim>(side == 0 ? pair.slave : pair.master),
                          other = nodes_of<dim>(side == 0 ? pair.master : pair.slave);
      const auto apart = [&](int node) {
        return least_of(other, [&](int to) {
          return (X[static_cast<std::size_t>(node)] - X[static_cast<std::size_t>(to)]).norm();
        });
      };
      std::vector<int> here;
      for (const int node : nodes)
        if (own.contains(node)) here.push_back(node);
      if (!here.empty()) least = std::min(least, least_of(here, apart) - least_of(own, apart));
    }
  return least;
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
  const bool driven = rolling.force[static_cast<std::size_t>(axis)].value_or(0) != 0;
  return std::max({driven ? 1.0 : 0.0, part_along<dim>(rolling.velocity, axis),
                   part_along<dim>(rolling.creepage_at(x), axis)});
}

/// Of one phase, and since the first phase of a path.
template <int dim>
double slides_across(const AssemblyParts<dim>& parts, const Phase<dim>& phase,
                     const Phase<dim>& first, const Vector<dim>& x, int axis) {
  double most = 0;
  const auto add = [&](const RigidMotion<dim>& motion, const Vector<dim>& streaming) {
    most = std::max(most, part_along<dim>(motion.at(x) - streaming, axis, motion.across_at(x)));
  };
  if (parts.pairs.empty()) {
    add(phase.counter_body.motion, parts.interface.streaming);
    if (parts.interface.sticks)
      most = std::max(
          most, part_along<dim>(phase.counter_body.position - first.counter_body.position, axis));
  }
  for (const MortarPair<dim>& pair : parts.pairs) {
    const PairPlaces<dim> now(pair, phase.places), before(pair, first.places);
    add(now.motion, Vector<dim>::Zero());
    const auto apart = [&](const PairPlaces<dim>& at) {
      return Vector<dim>(at.of[1].of(x) - at.of[0].of(x));
    };
    if (parts.interface.sticks)
      most = std::max(most, part_along<dim>(apart(now) - apart(before), axis));
  }
  for (const Guide<dim>& guide : phase.counter_body.guides)
    if (guide.force && *guide.force != 0 && guide.share == 0)
      most = std::max(most, std::abs(guide.along[axis]));
  return most;
}

/// What of the motions and forces between the bodies is across the plane, by the whole, at most.
template <int dim>
double across(const AssemblyParts<dim>& parts, const CutPlane<dim>& plane) {
  const std::vector<Phase<dim>> phases = parts.instants();
  double most = 0;
  for (const int node : plane.nodes) {
    const Vector<dim>& x = parts.mesh.nodes[static_cast<std::size_t>(node)];
    if (parts.interface.rolling)
      most = std::max(most, rolls_across(*parts.interface.rolling, x, plane.axis));
    else
      for (const Phase<dim>& phase : phases)
        most = std::max(most, slides_across(parts, phase, phases.front(), x, plane.axis));
  }
  return most;
}

template <int dim>
bool has_friction(const AssemblyParts<dim>& parts) {
  return parts.interface.friction > 0 ||
         std::ranges::any_of(parts.pairs, [](const auto& pair) { return pair.friction > 0; });
}

}  // namespace

template <int dim>
std::vector<std::string> remarks_on_symmetry(const AssemblyParts<dim>& parts,
                                             const Magnitudes& expected) {
  constexpr double little = 1e-6;  // of what rounding leaves across
  if (!has_friction(parts) || parts.section() == Section::meridian) return {};
  std::set<int> contact;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    contact.merge(nodes_of<dim>(surface.facets));
  const double reach = 1.5 * (expected.deepest + expected.scales.displacement) +
                       (parts.pairs.empty() ? 0 : 2 * expected.facet);  // nodes are not opposite
  std::vector<std::string> remarks;
  for (const CutPlane<dim>& plane : cut_planes(parts, contact)) {
    const double part = across(parts, plane);
    if (part <= little || !(farther<dim>(parts, contact, plane.nodes) <= reach)) continue;
    const char axis = "xyz"[plane.axis];
    remarks.push_back(fmt::format(
        "{} holds {} where the contact ends, at {} = {:.4g} mm, as a plane of symmetry does, but a "
        "part of {:.2g} of the partner's motion or force is along {}: friction across a plane of "
        "symmetry has no mirror image, model the whole body",
        plane.support, axis, axis, plane.place, part, axis));
  }
  return remarks;
}

template std::vector<std::string> remarks_on_symmetry(const AssemblyParts<2>&, const Magnitudes&);
template std::vector<std::string> remarks_on_symmetry(const AssemblyParts<3>&, const Magnitudes&);

}  // namespace gnomon::part
