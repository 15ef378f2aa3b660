#include "mesh/cell_faces.hpp"

namespace gnomon {

const CellFaces& faces_of(ElementKind kind) {
  static const CellFaces tetrahedron = {
      {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 0, 2, 1}},
      {{0, 1, 2, -1}, {0, 1, 3, -1}, {0, 2, 3, -1}, {1, 2, 3, -1}}};
  static const CellFaces wedge = {
      {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}},
      {{0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {0, 2, 5, 3}}};
  static const CellFaces hexahedron = {
      {{0, 1, 3, 4},
       {1, 2, 0, 5},
       {2, 3, 1, 6},
       {3, 0, 2, 7},
       {4, 7, 5, 0},
       {5, 4, 6, 1},
       {6, 5, 7, 2},
       {7, 6, 4, 3}},
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
  return kind == ElementKind::tetrahedron ? tetrahedron
         : kind == ElementKind::wedge     ? wedge
                                          : hexahedron;
}

std::vector<std::vector<int>> facets_of(ElementKind kind, std::span<const int> nodes) {
  std::vector<std::vector<int>> facets;
  if (dimension_of(kind) == 2) {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      facets.push_back({nodes[a], nodes[(a + 1) % nodes.size()]});
    return facets;
  }
  for (const CellFace& face : faces_of(kind).faces) {
    std::vector<int>& facet = facets.emplace_back();
    for (const int local : face)
      if (local >= 0) facet.push_back(nodes[static_cast<std::size_t>(local)]);
  }
  return facets;
}

}  // namespace gnomon
