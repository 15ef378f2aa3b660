// Meshes as files have them, sound ones to be damaged by tests.
#pragma once

#include <fmt/format.h>

#include <gnomon/mesh/imported_mesh.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <initializer_list>

#include "support/structured_hexahedra.hpp"

namespace gnomon::testing {

/// Node tags from 1, elements from 101 (facets) and 501 (cells).
struct Builder {
  ImportedMesh mesh;

  explicit Builder(int dimension) {
    mesh.file = "part.msh";
    mesh.dimension = dimension;
  }
  int node(double x, double y, double z = 0) {
    mesh.nodes.push_back({x, y, z});
    mesh.node_tags.push_back(std::ssize(mesh.nodes));
    return static_cast<int>(mesh.nodes.size()) - 1;
  }
  int cell(ElementKind kind, std::initializer_list<int> nodes) {
    mesh.cells.add(kind, 501 + mesh.cells.size(), {nodes.begin(), nodes.size()});
    return mesh.cells.size() - 1;
  }
  int facet(ElementKind kind, std::initializer_list<int> nodes) {
    mesh.facets.add(kind, 101 + mesh.facets.size(), {nodes.begin(), nodes.size()});
    return mesh.facets.size() - 1;
  }
  void group(const std::string& name, int dimension, std::vector<int> members) {
    mesh.groups.push_back({name, dimension, std::move(members)});
  }
};

/// A mesh of gnomon's as a file would have it: every boundary part a group, all cells "body".
template <int dim>
ImportedMesh imported(const Mesh<dim>& mesh) {
  Builder builder(dim);
  for (const Vector<dim>& X : mesh.nodes) builder.node(X[0], X[1], dim == 3 ? X[dim - 1] : 0);
  std::vector<int> all;
  for (const auto& cell : mesh.cells) {
    all.push_back(builder.mesh.cells.size());
    builder.mesh.cells.add(dim == 2 ? ElementKind::quadrilateral : ElementKind::hexahedron,
                           501 + builder.mesh.cells.size(), cell);
  }
  for (const auto& [name, facets] : mesh.boundary) {
    std::vector<int> members;
    for (const auto& facet : facets) {
      members.push_back(builder.mesh.facets.size());
      builder.mesh.facets.add(dim == 2 ? ElementKind::line : ElementKind::quadrilateral,
                              101 + builder.mesh.facets.size(), facet);
    }
    builder.group(name, dim - 1, members);
  }
  builder.group("body", dim, all);
  return builder.mesh;
}

/// The unit square, n by n cells; nodes row by row from the origin.
inline ImportedMesh square(int n) {
  return imported<2>(
      structured_quadrilaterals(n, n, [](double s, double t) { return Vector<2>(s, t); }));
}

/// The unit cube, n by n by n cells.
inline ImportedMesh cube(int n) {
  return imported<3>(structured_hexahedra(
      n, n, n, [](double r, double s, double t) { return Vector<3>(r, s, t); }));
}

/// The quadrilaterals whose number `is_cut` accepts as two triangles each, without groups of cells.
template <class IsCut>
ImportedMesh with_triangles(ImportedMesh mesh, IsCut is_cut) {
  ElementList cut;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto c = mesh.cells.at(cell);
    if (!is_cut(cell)) {
      cut.add(ElementKind::quadrilateral, cell, c);
      continue;
    }
    cut.add(ElementKind::triangle, cell, std::array{c[0], c[1], c[2]});
    cut.add(ElementKind::triangle, cell, std::array{c[0], c[2], c[3]});
  }
  mesh.cells = cut;
  std::erase_if(mesh.groups, [](const MeshGroup& group) { return group.dimension == 2; });
  return mesh;
}

/// The facets of the boundary that a group in a file would name, as elements of the list.
inline int add_facet(ImportedMesh& mesh, std::initializer_list<int> nodes) {
  mesh.facets.add(nodes.size() == 2   ? ElementKind::line
                  : nodes.size() == 3 ? ElementKind::triangle
                                      : ElementKind::quadrilateral,
                  101 + mesh.facets.size(), {nodes.begin(), nodes.size()});
  return mesh.facets.size() - 1;
}

/// ASCII text of the format 2.2, as Gmsh writes it: the first group of an element is its tag.
inline std::string msh22(const ImportedMesh& mesh) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  text += fmt::format("{}\n", mesh.groups.size());
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    text += fmt::format("{} {} \"{}\"\n", mesh.groups[g].dimension, g + 1, mesh.groups[g].name);
  text += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    text += fmt::format("{} {} {} {}\n", mesh.node_tags[n], mesh.nodes[n][0], mesh.nodes[n][1],
                        mesh.nodes[n][2]);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.facets.size() + mesh.cells.size());
  const auto add = [&](const ElementList& list, int dimension) {
    constexpr int types[] = {15, 1, 2, 3, 4, 5, 6, 7};
    for (int e = 0; e < list.size(); ++e) {
      int group = 0;
      for (std::size_t g = 0; g < mesh.groups.size() && group == 0; ++g)
        if (mesh.groups[g].dimension == dimension)
          for (int member : mesh.groups[g].members)
            if (member == e) group = static_cast<int>(g) + 1;
      text += fmt::format("{} {} 2 {} {}", list.tags[e], types[static_cast<int>(list.kinds[e])],
                          group, std::max(group, 1));
      for (int node : list.at(e)) text += fmt::format(" {}", mesh.node_tags[node]);
      text += '\n';
    }
  };
  add(mesh.facets, mesh.dimension - 1);
  add(mesh.cells, mesh.dimension);
  return text + "$EndElements\n";
}

}  // namespace gnomon::testing
