#include <cmath>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <sstream>

#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

namespace {

Vector<2> facet_area(const Mesh<2>& mesh, const Mesh<2>::Facet& facet) {
  const Vector<2> along = mesh.nodes[facet[1]] - mesh.nodes[facet[0]];
  return {along[1], -along[0]};
}

Vector<3> facet_area(const Mesh<3>& mesh, const Mesh<3>::Facet& facet) {
  return (mesh.nodes[facet[2]] - mesh.nodes[facet[0]])
             .cross(mesh.nodes[facet[3]] - mesh.nodes[facet[1]]) /
         2;
}

/// What every body must fulfil: its boundary is closed and looks outwards.
template <int dim>
void check(const ImportedMesh& imported) {
  const ImportedBody<dim> body = check_mesh<dim>(imported);
  const Mesh<dim>& mesh = body.mesh;
  Vector<dim> closing = Vector<dim>::Zero();
  double area = 0, volume = 0;
  for (const auto& facet : body.exterior) {
    const Vector<dim> normal = facet_area(mesh, facet);
    Vector<dim> centre = Vector<dim>::Zero();
    for (int node : facet) centre += (mesh.nodes[node] - mesh.nodes[0]) / facet.size();
    closing += normal;
    area += normal.norm();
    volume += normal.dot(centre) / dim;
  }
  demand(closing.norm() <= 1e-6 * area, "the boundary is closed");
  demand(volume > 0 || volume > -1e-9 * std::pow(area, dim / (dim - 1.0)),
         "the boundary looks outwards");
  for (const auto& [name, facets] : mesh.boundary)
    demand(facets.size() <= body.exterior.size(), "a part is part of the boundary");
  demand(body.node_tags.size() == mesh.nodes.size(), "every node has its tag");
  demand(body.cell_tags.size() == mesh.cells.size(), "every cell has its tag");
}

void check_any(const ImportedMesh& mesh) {
  if (mesh.dimension == 3)
    check<3>(mesh);
  else
    check<2>(mesh);
}

void read_element(std::istringstream& line, ElementList& list) {
  int kind = 0;
  if (!(line >> kind) || kind < 0 || kind >= element_kinds) return;
  std::vector<int> nodes;
  for (int node; line >> node;) nodes.push_back(node);
  list.add(ElementKind(kind), list.size() + 1, nodes);
}

ImportedMesh read_lines(std::string_view bytes) {
  ImportedMesh mesh;
  mesh.file = "part.msh";
  std::istringstream lines{std::string(bytes)};
  for (std::string text; std::getline(lines, text);) {
    std::istringstream line(text);
    std::string word;
    line >> word;
    if (word == "node") {
      std::array<double, 3> place{};
      for (double& x : place) line >> x;
      mesh.nodes.push_back(place);
      mesh.node_tags.push_back(std::ssize(mesh.nodes));
    } else if (word == "cell") {
      read_element(line, mesh.cells);
    } else if (word == "facet") {
      read_element(line, mesh.facets);
    } else if (word == "group") {
      MeshGroup group;
      line >> group.name >> group.dimension;
      for (int member; line >> member;) group.members.push_back(member);
      mesh.groups.push_back(group);
    }
  }
  for (ElementKind kind : mesh.cells.kinds) mesh.dimension = dimension_of(kind);
  return mesh;
}

}  // namespace

void mesh(std::string_view bytes) {
  static const Folder folder("mesh");
  check_any(read_mesh_file(folder.put("m.msh", bytes)));
}

void body(std::string_view bytes) {
  check_any(read_lines(bytes));
}

}  // namespace gnomon::fuzz
