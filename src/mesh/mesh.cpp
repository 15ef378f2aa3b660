#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/mesh/named_part.hpp>

#include "mesh/facet_table.hpp"

namespace gnomon {

template <int dim>
const std::vector<typename Mesh<dim>::Facet>& named_part(const Mesh<dim>& mesh,
                                                         const std::string& name) {
  const auto found = mesh.boundary.find(name);
  if (found != mesh.boundary.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& part : mesh.boundary) names.push_back(part.first);
  throw InputError(fmt::format("the mesh has no boundary part called \"{}\", it has {}", name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

template <int dim>
std::vector<int> Mesh<dim>::boundary_nodes(const std::string& name) const {
  std::vector<int> result;
  for (const Facet& facet : named_part(*this, name))
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
template const std::vector<Mesh<2>::Facet>& named_part(const Mesh<2>&, const std::string&);
template const std::vector<Mesh<3>::Facet>& named_part(const Mesh<3>&, const std::string&);
template std::vector<int> Mesh<2>::boundary_nodes(const std::string&) const;
template std::vector<int> Mesh<3>::boundary_nodes(const std::string&) const;
template std::vector<int> nodes_where(const Mesh<2>&, const std::function<bool(const Vector<2>&)>&);
template std::vector<int> nodes_where(const Mesh<3>&, const std::function<bool(const Vector<3>&)>&);

}  // namespace gnomon
