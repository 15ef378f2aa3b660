#include "part/stored_part.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>

namespace gnomon {

namespace {

template <class Facet>
std::vector<int> flat(const std::vector<Facet>& facets) {
  std::vector<int> nodes;
  for (const Facet& facet : facets) nodes.insert(nodes.end(), facet.begin(), facet.end());
  return nodes;
}

template <class Group>
std::vector<Group> grouped(const std::vector<int>& nodes) {
  std::vector<Group> groups(nodes.size() / std::tuple_size_v<Group>);
  for (std::size_t k = 0; k < groups.size(); ++k)
    std::copy_n(nodes.begin() + static_cast<std::ptrdiff_t>(k * std::tuple_size_v<Group>),
                std::tuple_size_v<Group>, groups[k].begin());
  return groups;
}

}  // namespace

template <int dim>
std::vector<MeshPart> stored_parts(const ImportedBody<dim>& part) {
  std::vector<MeshPart> parts = {{MeshPart::Kind::exterior, "", flat(part.exterior)}};
  for (const auto& [name, facets] : part.mesh.boundary)
    parts.push_back({MeshPart::Kind::facets, name, flat(facets)});
  for (const auto& [name, nodes] : part.point_groups)
    parts.push_back({MeshPart::Kind::points, name, nodes});
  for (const auto& [name, cells] : part.cell_groups)
    parts.push_back({MeshPart::Kind::cells, name, cells});
  return parts;
}

template <int dim>
ImportedBody<dim> part_of_grid(const Grid& grid, const std::string& file) {
  using Facet = typename Mesh<dim>::Facet;
  ImportedBody<dim> part;
  part.file = file;
  for (const auto& X : grid.points) {
    Vector<dim>& node = part.mesh.nodes.emplace_back();
    std::copy_n(X.begin(), dim, node.begin());
  }
  const auto nodes = static_cast<int>(grid.points.size());
  if (std::any_of(grid.cells.begin(), grid.cells.end(),
                  [nodes](int node) { return node < 0 || node >= nodes; }))
    throw InputError(file + ": its mesh has cells of nodes that it does not have");
  part.mesh.cells = grouped<typename Mesh<dim>::Cell>(grid.cells);
  for (const MeshPart& stored : grid.parts) switch (stored.kind) {
      case MeshPart::Kind::exterior:
        part.exterior = grouped<Facet>(stored.nodes);
        break;
      case MeshPart::Kind::facets:
        part.mesh.boundary[stored.name] = grouped<Facet>(stored.nodes);
        break;
      case MeshPart::Kind::points:
        part.point_groups[stored.name] = stored.nodes;
        break;
      case MeshPart::Kind::cells:
        part.cell_groups[stored.name] = stored.nodes;
        break;
    }
  if (part.exterior.empty())
    throw InputError(file + ": its mesh has no boundary, so that the run cannot go on");
  return part;
}

template std::vector<MeshPart> stored_parts(const ImportedBody<2>&);
template std::vector<MeshPart> stored_parts(const ImportedBody<3>&);
template ImportedBody<2> part_of_grid(const Grid&, const std::string&);
template ImportedBody<3> part_of_grid(const Grid&, const std::string&);

}  // namespace gnomon
