#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/section.hpp>

#include "mesh/facet_table.hpp"

namespace gnomon {

template <int dim>
std::vector<int> Mesh<dim>::boundary_nodes(const std::string& name) const {
  const auto part = boundary.find(name);
  if (part == boundary.end()) {
    std::vector<std::string> names;
    for (const auto& other : boundary) names.push_back(other.first);
    throw InputError(
        fmt::format("the mesh has no boundary part called \"{}\", it has {}", name,
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  std::vector<int> result;
  for (const Facet& facet : part->second) result.insert(result.end(), facet.begin(), facet.end());
  sort_once(result);
  return result;
}

template <int dim>
std::vector<typename Mesh<dim>::Facet> exterior_facets(const Mesh<dim>& mesh) {
  return FacetTable<dim>(mesh).exterior_facets();
}

std::vector<int> axis_nodes(const Mesh<2>& mesh) {
  double largest = 0;
  for (const Vector<2>& X : mesh.nodes) largest = std::max(largest, X[0]);
  const double near = 1e-9 * largest;
  std::vector<int> nodes;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const Vector<2>& X = mesh.nodes[node];
    if (X[0] < -near)
      throw InputError(fmt::format(
          "the mesh: expected r >= 0 in a body of revolution about r = 0, got a node at ({:g}, "
          "{:g})",
          X[0], X[1]));
    if (X[0] <= near) nodes.push_back(static_cast<int>(node));
  }
  return nodes;
}

template std::vector<Mesh<2>::Facet> exterior_facets(const Mesh<2>&);
template std::vector<Mesh<3>::Facet> exterior_facets(const Mesh<3>&);
template std::vector<int> Mesh<2>::boundary_nodes(const std::string&) const;
template std::vector<int> Mesh<3>::boundary_nodes(const std::string&) const;

}  // namespace gnomon
