// Where the boundary of a mesh lies between its nodes, as far as its nodes tell.
#pragma once

#include <array>
#include <gnomon/mesh/imported_mesh.hpp>
#include <map>
#include <utility>
#include <vector>

namespace gnomon {

/// The two nodes of an edge, ascending.
using Edge = std::array<int, 2>;

inline Edge edge_of(int a, int b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// Displacements of points half way along edges.
using EdgeBulges = std::map<Edge, std::array<double, 3>>;

/// The facets with cells of one group only, each with a cell that it belongs to.
std::vector<std::pair<std::vector<int>, int>> outer_facets(const ImportedMesh& mesh);

/// From the middle of each edge of the boundary, and of the interfaces between groups of cells, to
/// the smooth curve or surface through the nodes: the cubic whose tangents at the ends are those
/// there, of such a length that an arc is exact. Tangents are means of both sides (normals of all
/// facets around), exact on circles and spheres (Max 1999). Where the boundary turns by more than
/// 40 degrees at a node or an edge, and where three of its parts meet, it has a corner: an edge
/// with one end there takes the curvature of its other end; one with both stays straight, as does
/// one that leaves a straight neighbour.
EdgeBulges edge_bulges(const ImportedMesh& mesh);

}  // namespace gnomon
