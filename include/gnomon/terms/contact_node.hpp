// One contact node with the facets that meet there: eq. (25), (26) and (14) by nodal quadrature.
//
// Each facet gives its corner an area vector S_f (normal times the corner's share of undeformed
// area: half a segment, a quarter of |a x b| of a bilinear facet). Then
//
//   A = sum_f |S_f|,   N = sum_f A^_f S_f/|S_f| / sum_f A^_f        (A^_f: initial shares, eq. 35)
//   force      = A lambda_eff n          row of u
//   constraint = C_N                     row of lambda
//   velocity   = -Wdot N                 row of d: ddot - velocity = 0, eq. (14)
#pragma once

#include <array>
#include <gnomon/mesh.hpp>
#include <gnomon/terms/contact_law.hpp>
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

enum class NormalRule { averaged, normalised };

/// Constants of all contact nodes.
template <int dim>
struct ContactParameters {
  RigidPlane<dim> counter_body;
  FrictionlessWear wear;
  NormalRule normal_rule = NormalRule::averaged;
  double rho = 1;  ///< [stress / length]
};

template <int dim, class Scalar = double>
using PatchNodal = Eigen::Matrix<Scalar, Eigen::Dynamic, dim, 0, max_patch_nodes, dim>;

/// Area and normal of a node in the undeformed configuration.
template <int dim, class Scalar = double>
struct NodalSurface {
  Scalar area;
  Vector<dim, Scalar> normal;

  NodalSurface(const ContactPatch<dim>& patch, const PatchNodal<dim, Scalar>& X, NormalRule rule);
};

/// Residual of a contact node.
template <int dim, class Scalar = double>
struct ContactNode {
  Vector<dim, Scalar> force;
  Scalar constraint;
  Vector<dim, Scalar> velocity;
  Scalar wear_rate;  ///< Wdot [length / time]
  Scalar traction;   ///< lambda_eff [stress]
  Scalar area;       ///< A
  bool active;

  /// X: undeformed positions of patch.nodes; u, lambda: of the node itself.
  ContactNode(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
              const PatchNodal<dim, Scalar>& X, const Vector<dim, Scalar>& u, const Scalar& lambda,
              Branch branch = Branch::by_sign);
};

/// Derivatives of ContactNode. The position x = X + u of the node enters through u and d alike, the
/// patch positions X through area and normal.
template <int dim>
struct ContactNodeTangent {
  Tensor<dim> force_by_x;
  Vector<dim> force_by_lambda;
  std::array<Tensor<dim>, max_patch_nodes> force_by_X;
  Vector<dim> constraint_by_x;
  double constraint_by_lambda;
  Tensor<dim> velocity_by_x;
  Vector<dim> velocity_by_lambda;
  std::array<Tensor<dim>, max_patch_nodes> velocity_by_X;

  ContactNodeTangent(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                     const PatchNodal<dim>& X, const Vector<dim>& u, double lambda,
                     Branch branch = Branch::by_sign);
};

// ---- templates on the scalar
// ---------------------------------------------------------------------

/// Area vector of a corner, linear (2D) or bilinear (3D) in the positions.
template <int dim, class Scalar>
Vector<dim, Scalar> corner_area_vector(const typename ContactPatch<dim>::Corner& corner,
                                       const PatchNodal<dim, Scalar>& X) {
  const Vector<dim, Scalar> a = (X.row(corner.nodes[1]) - X.row(corner.nodes[0])).transpose();
  if constexpr (dim == 2) {
    return Scalar(corner.sign / 2) * Vector<2, Scalar>(a[1], -a[0]);
  } else {
    const Vector<dim, Scalar> b = (X.row(corner.nodes[2]) - X.row(corner.nodes[0])).transpose();
    return a.cross(b) / Scalar(4);
  }
}

template <int dim, class Scalar>
NodalSurface<dim, Scalar>::NodalSurface(const ContactPatch<dim>& patch,
                                        const PatchNodal<dim, Scalar>& X, NormalRule rule) {
  area = Scalar(0);
  normal.setZero();
  for (const auto& corner : patch.corners) {
    const Vector<dim, Scalar> S = corner_area_vector<dim, Scalar>(corner, X);
    const Scalar share = S.norm();
    area += share;
    normal += Scalar(corner.initial_area / patch.initial_area) * S / share;
  }
  if (rule == NormalRule::normalised) normal /= Scalar(normal.norm());
}

template <int dim, class Scalar>
ContactNode<dim, Scalar>::ContactNode(const ContactParameters<dim>& parameters,
                                      const ContactPatch<dim>& patch,
                                      const PatchNodal<dim, Scalar>& X,
                                      const Vector<dim, Scalar>& u, const Scalar& lambda,
                                      Branch branch) {
  const NodalSurface<dim, Scalar> surface(patch, X, parameters.normal_rule);
  const Vector<dim, Scalar> x = X.row(0).transpose() + u;
  const UnilateralContact<Scalar> contact(lambda, parameters.counter_body.gap(x), parameters.rho,
                                          branch);
  active = contact.active;
  traction = contact.traction;
  area = surface.area;
  force = (area * traction) * parameters.counter_body.normal.template cast<Scalar>();
  constraint = contact.constraint;
  wear_rate = parameters.wear.rate(traction);
  velocity = -wear_rate * surface.normal;
}

}  // namespace gnomon
