#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/mesh/imported_body.hpp>
#include <iterator>

namespace gnomon {

namespace {

// Gmsh's numbers of kinds of elements.
constexpr int line = 1, quadrilateral = 3, hexahedron = 5, point = 15;

class GmshText {
public:
  /// A group of a dimension; returns its number.
  int add_group(int dimension, std::string name) {
    std::ranges::replace(name, '"', '\'');  // the format cannot express it
    groups_ += fmt::format("{} {} \"{}\"\n", dimension, ++group_count_, name);
    return group_count_;
  }
  /// An element of a group, 0: of none. Nodes count from 1 in the file.
  template <class Nodes>
  void add_element(int kind, int group, const Nodes& nodes) {
    const int entity = group > 0 ? group : no_group;
    fmt::format_to(std::back_inserter(elements_), "{} {} 2 {} {}", ++element_count_, kind, group,
                   entity);
    for (int node : nodes) fmt::format_to(std::back_inserter(elements_), " {}", node + 1);
    elements_ += '\n';
  }
  std::string text(const std::string& nodes, std::size_t node_count) const {
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n"
        "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
        group_count_, groups_, node_count, nodes, element_count_, elements_);
  }

private:
  static constexpr int no_group = 1'000'000;  // the entity of elements without a group
  std::string groups_, elements_;
  int group_count_ = 0;
  long element_count_ = 0;
};

/// Number of the first group of each cell.
template <int dim>
std::vector<int> groups_of_cells(const ImportedBody<dim>& body, GmshText& text) {
  std::vector<int> group(body.mesh.cells.size(), 0);
  for (const auto& [name, cells] : body.cell_groups) {
    const int number = text.add_group(dim, name);
    for (int cell : cells)
      if (group[cell] == 0) group[cell] = number;
  }
  return group;
}

}  // namespace

template <int dim>
std::string gmsh_text(const ImportedBody<dim>& body) {
  GmshText text;
  for (const auto& [name, points] : body.point_groups) {
    const int group = text.add_group(0, name);
    for (int node : points) text.add_element(point, group, std::array{node});
  }
  for (const auto& [name, facets] : body.mesh.boundary) {
    const int group = text.add_group(dim - 1, name);
    for (const auto& facet : facets)
      text.add_element(dim == 2 ? line : quadrilateral, group, facet);
  }
  const std::vector<int> groups = groups_of_cells(body, text);
  for (std::size_t cell = 0; cell < groups.size(); ++cell)
    text.add_element(dim == 2 ? quadrilateral : hexahedron, groups[cell], body.mesh.cells[cell]);
  std::string nodes;
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node) {
    const Vector<dim>& X = body.mesh.nodes[node];
    fmt::format_to(std::back_inserter(nodes), "{} {} {} {}\n", node + 1, X[0], X[1],
                   dim == 3 ? X[dim - 1] : 0.0);
  }
  return text.text(nodes, body.mesh.nodes.size());
}

template std::string gmsh_text(const ImportedBody<2>&);
template std::string gmsh_text(const ImportedBody<3>&);

}  // namespace gnomon
