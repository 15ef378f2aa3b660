// Corners and faces of cells in space, whatever their shape.
#pragma once

#include <array>
#include <gnomon/mesh/imported_mesh.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// A corner of a cell in space and its three neighbours, in a right-handed order.
using CellCorner = std::array<int, 4>;
/// Local nodes of a face, in the order around it; -1 where there are three.
using CellFace = std::array<int, 4>;

struct CellFaces {
  std::vector<CellCorner> corners;
  std::vector<CellFace> faces;
};

/// Of a tetrahedron, a wedge or a hexahedron.
const CellFaces& faces_of(ElementKind kind);

/// The facets of a cell of these nodes: edges of a polygon, or faces, in the order around them.
std::vector<std::vector<int>> facets_of(ElementKind kind, std::span<const int> nodes);

}  // namespace gnomon
