// The neighbourhood of a contact node on the contact surface.
#pragma once

#include <array>
#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

/// Upper bounds of a node's neighbourhood on the contact surface; meshes beyond them are refused.
inline constexpr int max_patch_facets = 8;
inline constexpr int max_patch_nodes = 17;

/// A contact node and its facets.
template <int dim>
struct ContactPatch {
  int node = 0;            ///< mesh node
  std::vector<int> nodes;  ///< mesh nodes of the facets, each once; nodes[0] == node
  struct Corner {
    std::array<int, dim> nodes;  ///< positions in `nodes`: this node, then (2D) the other end,
                                 ///< (3D) the next and the previous corner
    double sign;                 ///< 2D: +1 when this node comes first in the facet
    double initial_area;         ///< A^_f [length^(dim-1)]
  };
  std::vector<Corner> corners;
  double initial_area = 0;  ///< sum of A^_f
};

/// Patches of all nodes of a surface, in ascending order of nodes (2D: along the surface when its
/// nodes are numbered so). Throws Error beyond the bounds above.
template <int dim>
std::vector<ContactPatch<dim>> contact_patches(
    const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets);

template <int dim, class Scalar = double>
using PatchNodal = Eigen::Matrix<Scalar, Eigen::Dynamic, dim, 0, max_patch_nodes, dim>;

/// Edges of a facet at a corner, from `Y`, the positions of the patch; a column an edge.
template <int dim, class Scalar>
Eigen::Matrix<Scalar, dim, dim - 1> corner_edges(const typename ContactPatch<dim>::Corner& corner,
                                                 const PatchNodal<dim, Scalar>& Y) {
  Eigen::Matrix<Scalar, dim, dim - 1> edges;
  for (int j = 1; j < dim; ++j)
    edges.col(j - 1) = (Y.row(corner.nodes[j]) - Y.row(corner.nodes[0])).transpose();
  return edges;
}

/// Area vector of a corner, linear (2D) or bilinear (3D) in the positions.
template <int dim, class Scalar>
Vector<dim, Scalar> corner_area_vector(const typename ContactPatch<dim>::Corner& corner,
                                       const PatchNodal<dim, Scalar>& X) {
  const auto edges = corner_edges<dim, Scalar>(corner, X);
  const Vector<dim, Scalar> a = edges.col(0);
  if constexpr (dim == 2) {
    return Scalar(corner.sign / 2) * Vector<2, Scalar>(a[1], -a[0]);
  } else {
    const Vector<dim, Scalar> b = edges.col(1);
    return a.cross(b) / Scalar(4);
  }
}

}  // namespace gnomon
