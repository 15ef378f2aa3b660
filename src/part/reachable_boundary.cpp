#include "part/reachable_boundary.hpp"

#include <algorithm>
#include <gnomon/model/joining_boundary.hpp>
#include <limits>

namespace gnomon::part {

namespace {

/// How far the counter-body of an instant moves to touch each node; infinite where it passes by.
template <int dim>
class Travels {
public:
  Travels(const AssemblyParts<dim>& parts, const CounterBody<dim>& other) : other_(other) {
    for (const auto& facet : facets_of(parts.interface.surfaces))
      for (const int node : facet) first_ = std::min(first_, to(parts.mesh.nodes[node]));
  }

  /// Whether it touches the node at most `depth` behind its first touch, and the body faces it
  /// there, seen from where it touches first.
  bool within(double depth, const ContactPatch<dim>& patch) const {
    const Vector<dim>& X = patch.initial_position;
    return to(X) - first_ <= depth &&
           faces<dim>(patch.initial_normal,
                      other_.unchecked_distance(other_.seen(X, first_), 0).normal);
  }

private:
  double to(const Vector<dim>& X) const { return other_.travel_to(X); }

  const CounterBody<dim>& other_;
  double first_ = std::numeric_limits<double>::infinity();
};

}  // namespace

template <int dim>
Surface<dim> reachable_boundary(const AssemblyParts<dim>& parts, double depth) {
  const auto instants = parts.instants();
  std::vector<Travels<dim>> travels;
  for (const Phase<dim>& instant : instants) travels.emplace_back(parts, instant.counter_body);
  return joining_boundary<dim>(parts, [&](const ContactPatch<dim>& patch) {
    return std::ranges::any_of(travels,
                               [&](const auto& each) { return each.within(depth, patch); });
  });
}

template Surface<2> reachable_boundary(const AssemblyParts<2>&, double);
template Surface<3> reachable_boundary(const AssemblyParts<3>&, double);

}  // namespace gnomon::part
