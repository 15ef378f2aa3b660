// The neighbourhood of a contact node on the contact surface.
#pragma once

#include <array>
#include <cmath>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/mesh/section.hpp>
#include <vector>

namespace gnomon {

/// Upper bounds of a node's neighbourhood on the contact surface; meshes beyond them are refused.
/// Up to ten triangles meet at a node of an unstructured mesh, and as many of the quadrilaterals
/// that they are subdivided into.
inline constexpr int max_patch_facets = 16;
inline constexpr int max_patch_nodes = 2 * max_patch_facets + 1;

/// A contact node and its facets.
template <int dim>
struct ContactPatch {
  int node = 0;            ///< mesh node
  std::vector<int> nodes;  ///< mesh nodes of the facets, each once; nodes[0] == node
  struct Corner {
    /// Positions in `nodes`: this node, then (2D) the other end, (3D) the next, the previous and
    /// the opposite corner.
    std::array<int, (1 << (dim - 1))> nodes;
    double sign;  ///< 2D: +1 when this node comes first in the facet
    /// Integral of the node's shape function over the initial facet, by |corner_area_vector|: 1
    /// where the facet is a parallelogram. Without it a uniform pressure on the quadrilaterals of a
    /// subdivided triangle would be one of 0.78, 1 and 1.67 at its nodes.
    double share = 1;
    double
        initial_area;  ///< A^_f: that integral [length^(dim-1); length^2 of a body of revolution]
    Section section = Section::plane;  ///< 2D: of what the facet is a section
  };
  std::vector<Corner> corners;
  /// Corners of facets at this node that belong to the rest of the body's boundary: they have no
  /// contact and no wear, but the node moves them when it moves.
  std::vector<Corner> corners_beyond;
  double initial_area = 0;       ///< sum of A^_f
  Vector<dim> initial_position;  ///< X^ of the node [length]
  Vector<dim> initial_normal;    ///< N^: unit, average of the facets' by A^_f
  Tensor<dim> initial_spread;    ///< mean of (X - X^)(X - X^)' over the node's share [length^2]
  /// Orthogonal projector on the directions in which the node's shape may move.
  Tensor<dim> shape_free = Tensor<dim>::Identity();

  bool may_move() const { return !shape_free.isZero(0); }
};

/// Patches of all nodes of a surface, in ascending order of nodes (2D: along the surface when its
/// nodes are numbered so). Facets of `boundary` that touch the surface but do not belong to it
/// become corners_beyond. Throws InputError if the bounds above are exceeded or if a facet of the
/// surface lies on the axis of a body of revolution.
template <int dim>
std::vector<ContactPatch<dim>> contact_patches(
    const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
    const std::vector<typename Mesh<dim>::Facet>& boundary = {}, Section section = Section::plane);

template <int dim, class Scalar = double>
using PatchNodal = Eigen::Matrix<Scalar, Eigen::Dynamic, dim, 0, max_patch_nodes, dim>;

/// Edges of a facet at a corner, from the positions `Y` of the patch; one column per edge.
template <int dim, class Scalar>
Eigen::Matrix<Scalar, dim, dim - 1> corner_edges(const typename ContactPatch<dim>::Corner& corner,
                                                 const PatchNodal<dim, Scalar>& Y) {
  Eigen::Matrix<Scalar, dim, dim - 1> edges;
  for (int j = 1; j < dim; ++j)
    edges.col(j - 1) = (Y.row(corner.nodes[j]) - Y.row(corner.nodes[0])).transpose();
  return edges;
}

/// Per area vector of a corner in the plane, that of the whole circumference at the undeformed or
/// current radii of its nodes: 2 pi times the mean radius, weighted by the corner's shape function.
template <class Scalar>
Scalar corner_circumference(const ContactPatch<2>::Corner& corner, const PatchNodal<2, Scalar>& X) {
  return Scalar(2 * M_PI / 3) * (Scalar(2) * X(corner.nodes[0], 0) + X(corner.nodes[1], 0));
}

/// Area vector of a corner, linear (2D; quadratic for a body of revolution) or bilinear (3D) in the
/// positions. Multiplied by the corner's share, in 3D, it is the part of the facet's area that
/// belongs to the node.
template <int dim, class Scalar>
Vector<dim, Scalar> corner_area_vector(const typename ContactPatch<dim>::Corner& corner,
                                       const PatchNodal<dim, Scalar>& X) {
  const auto edges = corner_edges<dim, Scalar>(corner, X);
  const Vector<dim, Scalar> a = edges.col(0);
  if constexpr (dim == 2) {
    Scalar factor(corner.sign / 2);
    if (corner.section == Section::meridian)
      factor = Scalar(factor * corner_circumference<Scalar>(corner, X));
    return factor * Vector<2, Scalar>(a[1], -a[0]);
  } else {
    const Vector<dim, Scalar> b = edges.col(1);
    return a.cross(b) / Scalar(4);
  }
}

/// For a bilinear facet: 2 (X1 - X0) + X2 - X3 and 2 (X3 - X0) + X2 - X1, from corner 0.
template <class Scalar>
std::array<Vector<3, Scalar>, 2> corner_volume_edges(const ContactPatch<3>::Corner& corner,
                                                     const PatchNodal<3, Scalar>& X) {
  const auto [own, next, previous, opposite] = corner.nodes;
  return {Scalar(2) * (X.row(next) - X.row(own)) + X.row(opposite) - X.row(previous),
          Scalar(2) * (X.row(previous) - X.row(own)) + X.row(opposite) - X.row(next)};
}

/// The part of a facet in the derivative of the body's volume with respect to the position of a
/// corner: the integral of the corner's shape function times the area vector. For a segment it is
/// the area vector of the corner, also on a body of revolution; for a bilinear facet with the
/// corners 0 to 3 it is (2 (X1 - X0) + X2 - X3) x (2 (X3 - X0) + X2 - X1) / 36.
template <int dim, class Scalar>
Vector<dim, Scalar> corner_volume_gradient(const typename ContactPatch<dim>::Corner& corner,
                                           const PatchNodal<dim, Scalar>& X) {
  if constexpr (dim == 2) {
    return corner_area_vector<dim, Scalar>(corner, X);
  } else {
    const auto along = corner_volume_edges<Scalar>(corner, X);
    return along[0].cross(along[1]) / Scalar(36);
  }
}

}  // namespace gnomon
