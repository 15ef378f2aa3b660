// Where the boundary of a mesh lies between its nodes, as far as its nodes tell.
#pragma once

#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// The two nodes of an edge, ascending.
using Edge = std::array<int, 2>;

inline Edge edge_of(int a, int b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// Displacements of points half way along edges.
using EdgeBulges = std::map<Edge, std::array<double, 3>>;

/// From the middle of each edge of the boundary to the smooth curve or surface through the nodes:
/// the cubic whose tangents at the ends are those of the boundary there. On a circle its error is
/// of fourth order. Tangents are means of both sides (of all facets around), exact on circles and
/// spheres (Max 1999). Where the boundary turns by more than 30 degrees at a node or an edge it has
/// a corner: an edge with one end there takes the curvature of its other end, one with both stays
/// straight, as does one that leaves a straight neighbour. `exterior`: the whole boundary, oriented
/// outwards.
template <int dim>
EdgeBulges edge_bulges(const Mesh<dim>& mesh,
                       const std::vector<typename Mesh<dim>::Facet>& exterior);

}  // namespace gnomon
