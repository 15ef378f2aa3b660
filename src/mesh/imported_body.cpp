#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_body.hpp>

#include "mesh/edge_bulges.hpp"
#include "mesh/import_cells.hpp"
#include "mesh/import_nodes.hpp"
#include "mesh/round_facets.hpp"

namespace gnomon {

namespace {

/// "1 hexahedron", "3 tetrahedra".
std::string kind_text(long count, ElementKind kind) {
  std::string name = name_of(kind);
  const bool greek = name.ends_with("hedron");
  if (count != 1 && greek) name.replace(name.size() - 2, 2, "a");
  return fmt::format("{} {}{}", count, name, count != 1 && !greek ? "s" : "");
}

/// "3 triangles and 2 quadrilaterals".
std::string kinds_text(const ElementList& cells) {
  std::array<long, element_kinds> count{};
  for (ElementKind kind : cells.kinds) ++count[static_cast<int>(kind)];
  std::string text;
  for (int kind = 0; kind < element_kinds; ++kind)
    if (count[kind] > 0)
      text += (text.empty() ? "" : " and ") + kind_text(count[kind], ElementKind(kind));
  return text;
}

/// Edges stay straight unless the cells are split afterwards.
void subdivide_where_needed(ImportedMesh& mesh, int splits) {
  if (!needs_subdivision(mesh)) return;
  const std::string before = kinds_text(mesh.cells);
  mesh = subdivide(mesh, splits > 0 ? edge_bulges(mesh) : EdgeBulges());
  mesh.remarks.push_back(fmt::format("{} were subdivided into {}", before, kinds_text(mesh.cells)));
}

template <int dim>
ImportedBody<dim> body_of(ImportedMesh& mesh) {
  ImportedBody<dim> body;
  body.file = mesh.file;
  body.node_tags = std::move(mesh.node_tags);
  body.cell_tags = std::move(mesh.cells.tags);
  body.remarks = std::move(mesh.remarks);
  body.mesh.nodes.resize(mesh.nodes.size());
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (int i = 0; i < dim; ++i) body.mesh.nodes[node][i] = mesh.nodes[node][i];
  body.mesh.cells.resize(mesh.cells.kinds.size());
  for (std::size_t cell = 0; cell < body.mesh.cells.size(); ++cell)
    std::copy_n(mesh.cells.nodes.begin() + cell * Mesh<dim>::cell_nodes, Mesh<dim>::cell_nodes,
                body.mesh.cells[cell].begin());
  mesh.cells = {};
  mesh.nodes = {};
  return body;
}

/// Halves all elements, with new nodes on smooth curves through those of the boundary.
void split_cells(ImportedMesh& mesh, int times) {
  constexpr double most = 20e6;
  if (mesh.cells.size() * std::pow(2, mesh.dimension * times) > most)
    refuse_mesh(mesh.file, fmt::format("{} split {} times are more than {:g} million, expected "
                                       "a smaller mesh.split",
                                       counted(mesh.cells.size(), "cell"), times, most / 1e6));
  for (int k = 0; k < times; ++k) mesh = subdivide(mesh, edge_bulges(mesh));
}

}  // namespace

template <int dim>
ImportedBody<dim> check_mesh(ImportedMesh mesh, const std::vector<std::string>& ascending,
                             int splits, const std::vector<std::string>& separate) {
  check_content(mesh, dim);
  if (dim == 2) lay_in_plane(mesh);
  merge_equal_nodes(mesh, separate);
  drop_unused_nodes(mesh);
  drop_equal_cells(mesh);
  std::vector<RoundFacet> round;
  const auto find_round = [&] {
    if (separate.size() > 1) round = round_facets(mesh);
  };
  if (splits == 0) find_round();  // subdivided cells keep straight edges
  subdivide_where_needed(mesh, splits);
  split_cells(mesh, splits);
  if (splits > 0) find_round();
  ImportedBody<dim> body = body_of<dim>(mesh);
  body.round = std::move(round);
  try {
    orient_cells(body);
  } catch (const InputError& error) {
    if (splits == 0) throw;
    throw InputError(
        fmt::format("{} (with mesh.split = {}, which curves the boundary between its "
                    "nodes; smaller elements there help)",
                    error.what(), splits));
  }
  const FacetTable<dim> facets(body.mesh);
  body.exterior = facets.exterior_facets();
  check_connection(body, facets, std::max<std::size_t>(1, separate.size()));
  take_groups(body, facets, mesh);
  if constexpr (dim == 2) order_along_boundary(body, ascending);
  return body;
}

template ImportedBody<2> check_mesh(ImportedMesh, const std::vector<std::string>&, int,
                                    const std::vector<std::string>&);
template ImportedBody<3> check_mesh(ImportedMesh, const std::vector<std::string>&, int,
                                    const std::vector<std::string>&);

}  // namespace gnomon
