#include <algorithm>
#include <gnomon/mesh/mesh.hpp>

#include "mesh/facet_table.hpp"

namespace gnomon {

template <int dim>
std::vector<int> Mesh<dim>::boundary_nodes(const std::string& name) const {
  std::vector<int> result;
  for (const Facet& facet : boundary.at(name))
    result.insert(result.end(), facet.begin(), facet.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

template <int dim>
std::vector<int> nodes_where(const Mesh<dim>& mesh,
                             const std::function<bool(const Vector<dim>&)>& condition) {
  std::vector<int> result;
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    if (condition(mesh.nodes[node])) result.push_back(node);
  return result;
}

template <int dim>
std::vector<typename Mesh<dim>::Facet> exterior_facets(const Mesh<dim>& mesh) {
  const FacetTable<dim> table(mesh);
  std::vector<typename Mesh<dim>::Facet> result;
  for (int slot = 0; slot < table.slots(); ++slot)
    if (table.neighbour(slot) == table.exterior) result.push_back(table.facet(slot));
  return result;
}

template std::vector<Mesh<2>::Facet> exterior_facets(const Mesh<2>&);
template std::vector<Mesh<3>::Facet> exterior_facets(const Mesh<3>&);
template std::vector<int> Mesh<2>::boundary_nodes(const std::string&) const;
template std::vector<int> Mesh<3>::boundary_nodes(const std::string&) const;
template std::vector<int> nodes_where(const Mesh<2>&, const std::function<bool(const Vector<2>&)>&);
template std::vector<int> nodes_where(const Mesh<3>&, const std::function<bool(const Vector<3>&)>&);

}  // namespace gnomon
