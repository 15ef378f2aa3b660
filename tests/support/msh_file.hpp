// Meshes of gnomon's own as files of Gmsh, in its format 4.1.
#pragma once

#include <fmt/format.h>

#include <gnomon/mesh/mesh.hpp>
#include <string>

namespace gnomon::testing {

/// Hexahedra in the volume "body"; every part of the boundary is a surface with its name.
inline std::string msh41(const Mesh<3>& mesh) {
  const std::size_t parts = mesh.boundary.size(), nodes = mesh.nodes.size();
  std::string names, entities, numbers, positions, elements;
  std::size_t part = 0, element = 0;
  const auto add = [&](const auto& nodes_of) {
    elements += std::to_string(++element);
    for (int node : nodes_of) elements += ' ' + std::to_string(node + 1);
    elements += '\n';
  };
  for (const auto& [name, facets] : mesh.boundary) {
    names += fmt::format("2 {} \"{}\"\n", ++part, name);
    entities += fmt::format("{0} 0 0 0 1 1 1 1 {0} 0\n", part);
    elements += fmt::format("2 {} 3 {}\n", part, facets.size());
    for (const auto& facet : facets) add(facet);
  }
  elements += fmt::format("3 1 5 {}\n", mesh.cells.size());
  for (const auto& cell : mesh.cells) add(cell);
  for (std::size_t node = 0; node < nodes; ++node) {
    numbers += std::to_string(node + 1) + '\n';
    const Vector<3>& X = mesh.nodes[node];
    positions += fmt::format("{:.17g} {:.17g} {:.17g}\n", X[0], X[1], X[2]);
  }
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" +
         fmt::format("$PhysicalNames\n{}\n{}3 {} \"body\"\n$EndPhysicalNames\n", parts + 1, names,
                     parts + 1) +
         fmt::format("$Entities\n0 0 {} 1\n{}1 0 0 0 1 1 1 1 {} 0\n$EndEntities\n", parts, entities,
                     parts + 1) +
         fmt::format("$Nodes\n1 {0} 1 {0}\n3 1 0 {0}\n{1}{2}$EndNodes\n", nodes, numbers,
                     positions) +
         fmt::format("$Elements\n{} {} 1 {}\n{}$EndElements\n", parts + 1, element, element,
                     elements);
}

}  // namespace gnomon::testing
