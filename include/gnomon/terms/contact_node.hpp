// One contact node with the facets that meet there: eq. (25), (26) and (14) by nodal quadrature.
//
// Each facet gives its corner an area vector S_f (normal times the corner's share of undeformed
// area: half a segment, a quarter of |a x b| of a bilinear facet). Then
//
//   A = sum_f |S_f|,   N = sum_f A^_f S_f/|S_f| / sum_f A^_f        (A^_f: initial shares, eq. 35)
//   force      = A lambda_eff (n - friction s)    row of u;  s = v_T/|v_T|, eq. (25) and sec. 3.1
//   constraint = C_N                              row of lambda
//   velocity   = -Wdot N                          row of d: ddot - velocity = 0, eq. (14)
//
// v_T is the tangential part of F V - v^2 (sliding.hpp), n the normal of the counter-body.
#pragma once

#include <array>
#include <gnomon/laws/contact_law.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/sliding.hpp>

namespace gnomon {

enum class NormalRule { averaged, normalised };

/// Constants of all contact nodes.
template <int dim>
struct ContactParameters {
  CounterBody<dim> counter_body;
  ArchardWear wear;
  double friction = 0;                          ///< Coulomb's coefficient mu of eq. (10)
  Vector<dim> streaming = Vector<dim>::Zero();  ///< V of eq. (7), along the surface [length / time]
  NormalRule normal_rule = NormalRule::averaged;
  double rho = 1;  ///< [stress / length]
};

/// Area and normal of a node in the undeformed configuration.
template <int dim, class Scalar = double>
struct NodalSurface {
  Scalar area;
  Vector<dim, Scalar> normal;

  NodalSurface(const ContactPatch<dim>& patch, const PatchNodal<dim, Scalar>& X, NormalRule rule);
};

/// Where a contact node is: what its residual depends on.
template <int dim, class Scalar = double>
struct ContactInput {
  PatchNodal<dim, Scalar> X;  ///< undeformed positions of patch.nodes [length]
  PatchNodal<dim, Scalar> u;  ///< their displacements [length]
  Scalar lambda;              ///< of the node itself [stress]
  Scalar w = Scalar(0);       ///< rigid motion of the counter-body [length]
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
  Scalar gap;        ///< g [length]
  bool active;

  ContactNode(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
              const ContactInput<dim, Scalar>& at, Branch branch = Branch::by_sign);
};

/// Derivatives of ContactNode. The positions x = X + u enter through u and d alike, the undeformed
/// ones X through area, normal and streaming.
template <int dim>
struct ContactNodeTangent {
  template <class T>
  using PerNode = std::array<T, max_patch_nodes>;  ///< one a node of the patch

  PerNode<Tensor<dim>> force_by_x, force_by_X;
  Vector<dim> force_by_lambda, force_by_w;
  Vector<dim> constraint_by_x;  ///< of the node itself
  double constraint_by_lambda, constraint_by_w;
  PerNode<Tensor<dim>> velocity_by_x, velocity_by_X;
  Vector<dim> velocity_by_lambda, velocity_by_w;

  ContactNodeTangent(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                     const ContactInput<dim>& at, Branch branch = Branch::by_sign);
};

// ---- templates on the scalar
// ---------------------------------------------------------------------

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
                                      const ContactInput<dim, Scalar>& at, Branch branch) {
  const CounterBody<dim>& body = parameters.counter_body;
  const NodalSurface<dim, Scalar> surface(patch, at.X, parameters.normal_rule);
  const Vector<dim, Scalar> x = (at.X.row(0) + at.u.row(0)).transpose();
  const auto seen = body.template project<Scalar>(x - body.approach.template cast<Scalar>() * at.w);
  const UnilateralContact<Scalar> contact(at.lambda, seen.gap, parameters.rho, branch);
  const Sliding<dim, Scalar> sliding(
      relative_velocity<dim, Scalar>(patch, at.X, at.X + at.u, parameters.streaming, body.velocity),
      seen.normal);
  active = contact.active;
  traction = contact.traction;
  gap = seen.gap;
  area = surface.area;
  force = (area * traction) * (seen.normal - Scalar(parameters.friction) * sliding.direction);
  constraint = contact.constraint;
  wear_rate = parameters.wear.rate(traction, sliding.speed);
  velocity = -wear_rate * surface.normal;
}

}  // namespace gnomon
