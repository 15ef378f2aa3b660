#include "part/reachable_boundary.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <limits>
#include <set>

namespace gnomon::part {

namespace {

template <int dim>
using Facet = typename Mesh<dim>::Facet;

template <int dim>
Facet<dim> by_nodes(Facet<dim> facet) {
  std::ranges::sort(facet);
  return facet;
}

template <int dim>
std::set<Facet<dim>> facets_with_contact(const AssemblyParts<dim>& parts) {
  std::set<Facet<dim>> facets;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    for (const Facet<dim>& facet : surface.facets) facets.insert(by_nodes<dim>(facet));
  return facets;
}

/// How far the counter-body of an instant moves to touch each node; infinite where it passes by.
template <int dim>
class Travels {
public:
  Travels(const AssemblyParts<dim>& parts, const CounterBody<dim>& other)
      : mesh_(parts.mesh), other_(other) {
    for (const Surface<dim>& surface : parts.interface.surfaces)
      for (const Facet<dim>& facet : surface.facets)
        for (const int node : facet) first_ = std::min(first_, to(node));
  }
  double to(int node) const { return other_.travel_to(mesh_.nodes[node]); }
  double first() const { return first_; }

  /// Whether the body faces the counter-body there, from where that touches the node.
  bool faces(const ContactPatch<dim>& patch) const {
    constexpr double oblique = -0.5;  // cosine; steeper sides do not meet it
    const SignedDistance<dim> distance =
        other_.unchecked_distance(other_.seen(patch.initial_position, first_), 0);
    return distance.normal.allFinite() && distance.normal.dot(patch.initial_normal) < oblique;
  }

private:
  const Mesh<dim>& mesh_;
  const CounterBody<dim>& other_;
  double first_ = std::numeric_limits<double>::infinity();
};

/// Whether a support does not hold the node along its normal.
template <int dim>
bool may_yield(const AssemblyParts<dim>& parts, const ContactPatch<dim>& patch) {
  double free = 0;
  for (int i = 0; i < dim; ++i)
    if (!parts.supports.held(patch.node, i))
      free += patch.initial_normal[i] * patch.initial_normal[i];
  return free > 0.5;
}

}  // namespace

template <int dim>
Surface<dim> reachable_boundary(const AssemblyParts<dim>& parts, double depth) {
  const std::set<Facet<dim>> touching = facets_with_contact(parts);
  std::vector<Facet<dim>> others;
  for (const Facet<dim>& facet : parts.interface.boundary)
    if (!touching.contains(by_nodes<dim>(facet))) others.push_back(facet);
  std::set<int> reached;
  const auto instants = parts.instants();
  // Facets on the axis of a body of revolution have no area, and no contact.
  if (dim == 2 && parts.section() == Section::meridian)
    std::erase_if(others, [&](const Facet<dim>& facet) {
      return std::ranges::all_of(facet, [&](int node) { return parts.mesh.nodes[node][0] == 0; });
    });
  const auto patches = contact_patches<dim>(parts.mesh, others, {}, parts.section());
  for (const Phase<dim>& instant : instants) {
    const Travels<dim> travels(parts, instant.counter_body);
    for (const ContactPatch<dim>& patch : patches)
      if (travels.to(patch.node) - travels.first() <= depth && travels.faces(patch) &&
          may_yield(parts, patch))
        reached.insert(patch.node);
  }
  std::set<int> held;
  for (const ContactPatch<dim>& patch : patches)
    if (!may_yield(parts, patch)) held.insert(patch.node);
  Surface<dim> surface{.name = "", .facets = {}, .wear = WearLaw(), .wears = false};
  for (const Facet<dim>& facet : others)
    if (std::ranges::any_of(facet, [&](int node) { return reached.contains(node); }) &&
        std::ranges::none_of(facet, [&](int node) { return held.contains(node); }))
      surface.facets.push_back(facet);
  return surface;
}

template Surface<2> reachable_boundary(const AssemblyParts<2>&, double);
template Surface<3> reachable_boundary(const AssemblyParts<3>&, double);

}  // namespace gnomon::part
