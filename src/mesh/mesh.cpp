#include <algorithm>
#include <gnomon/mesh/mesh.hpp>

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

namespace {

/// Corners of the facets of a hexahedron in VTK order, counter-clockwise seen from outside.
constexpr int hexahedron_facets[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                         {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

}  // namespace

std::vector<Mesh<3>::Facet> exterior_facets(const Mesh<3>& mesh) {
  using Facet = Mesh<3>::Facet;
  const auto sorted = [](Facet facet) {
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  std::map<Facet, int> cells;
  std::vector<Facet> all;
  for (const auto& cell : mesh.cells)
    for (const auto& corners : hexahedron_facets) {
      all.push_back({cell[corners[0]], cell[corners[1]], cell[corners[2]], cell[corners[3]]});
      ++cells[sorted(all.back())];
    }
  std::erase_if(all, [&](const Facet& facet) { return cells.at(sorted(facet)) > 1; });
  return all;
}

template std::vector<int> Mesh<2>::boundary_nodes(const std::string&) const;
template std::vector<int> Mesh<3>::boundary_nodes(const std::string&) const;
template std::vector<int> nodes_where(const Mesh<2>&, const std::function<bool(const Vector<2>&)>&);
template std::vector<int> nodes_where(const Mesh<3>&, const std::function<bool(const Vector<3>&)>&);

}  // namespace gnomon
