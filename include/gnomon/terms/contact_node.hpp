// One contact node with its facets: eq. (25), (26) and (14) by nodal quadrature.
//
// Each facet gives its corner an area vector S_f (normal times the corner's share of undeformed
// area: half a segment, a quarter of |a x b| of a bilinear facet). Then
//
//   A = sum_f |S_f|
//   force      = A lambda_eff (n - friction s)    row of u;  s = v_T/|v_T|, eq. (25) and sec. 3.1
//   constraint = C_N                              row of lambda
//   velocity   = -Wdot P N                        row of d: ddot - velocity = 0, eq. (14)
//
// v_T is the tangential part of F V - v^2 and |v_T| the speed (sliding.hpp), n the normal of the
// counter-body, Wdot the rate of the wear law, N a normal by one of the rules below, P the
// projector on the directions in which the shape may move.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/base/lift.hpp>
#include <gnomon/laws/unilateral_contact.hpp>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/terms/sliding.hpp>
#include <span>

namespace gnomon {

/// The direction and length of N, by which a wear rate moves the shape.
///
///   averaged      sum_f A^_f S_f/|S_f| / sum_f A^_f    (A^_f: initial shares, eq. 35)
///   normalised    the same, normalised to length one
///   conservative  A a/|a|^2; a is the derivative of the body's volume with respect to the
///                 position of the node, along the directions in which its shape may move. The
///                 body then loses volume at the rate sum A Wdot, on every mesh.
enum class NormalRule { averaged, normalised, conservative };

/// Constants of all contact nodes.
template <int dim>
struct ContactParameters {
  CounterBody<dim> counter_body;
  WearLaw wear;
  double friction = 0;                          ///< Coulomb's coefficient mu of eq. (10)
  Vector<dim> streaming = Vector<dim>::Zero();  ///< V of eq. (7), along the surface [length / time]
  NormalRule normal_rule = NormalRule::averaged;
  double rho = 1;  ///< [stress / length]
};

/// Area and normal of a node in the undeformed configuration.
template <int dim, class Scalar = double>
struct NodalSurface {
  Scalar area;
  Vector<dim, Scalar> normal;  ///< N; zero if the conservative rule has none

  NodalSurface(const ContactPatch<dim>& patch, const PatchNodal<dim, Scalar>& X, NormalRule rule);
};

/// The state of a contact node: everything that its residual depends on.
template <int dim, class Scalar = double>
struct ContactInput {
  PatchNodal<dim, Scalar> X;  ///< undeformed positions of patch.nodes [length]
  PatchNodal<dim, Scalar> u;  ///< their displacements [length]
  Scalar lambda;              ///< of the node itself [stress]
  Scalar w = Scalar(0);       ///< motion of the counter-body along `approach` [length]
  WearMoment moment = {};     ///< read by the wear law, and by a counter-body that turns
};

/// The smooth branch of a contact node.
struct NodeBranch {
  Branch contact = Branch::by_sign;
  std::span<const char> wear = {};  ///< branches of the WearLaw

  NodeBranch(Branch branch = Branch::by_sign, std::span<const char> wear_branches = {})
      : contact(branch), wear(wear_branches) {}
};

/// Residual of a contact node.
template <int dim, class Scalar = double>
struct ContactNode {
  Vector<dim, Scalar> force;
  Scalar constraint;
  Vector<dim, Scalar> velocity;
  Scalar wear_rate;    ///< Wdot [length / time]
  Scalar traction;     ///< lambda_eff [stress]
  Scalar area;         ///< A
  Scalar gap;          ///< g [length]
  Vector<dim> normal;  ///< n of the counter-body
  bool active;

  ContactNode(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
              const ContactInput<dim, Scalar>& at, const NodeBranch& branch = {});
};

/// Number of switching functions of a contact node: that of contact, and those of the wear law.
template <int dim>
std::size_t switching_functions(const ContactParameters<dim>& parameters) {
  return 1 + parameters.wear.kinks();
}

/// Writes the switching functions of a contact node, each negative or zero where it is active:
/// lambda + rho g, then those of the wear law, on the given branch. An open node has p = 0 there.
template <int dim>
void contact_switching(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                       const ContactInput<dim>& at, const NodeBranch& branch,
                       std::span<double> values);

/// Derivatives of ContactNode. The positions x = X + u depend on u and d in the same way; the
/// undeformed positions X enter through area, normal and streaming.
template <int dim>
struct ContactNodeTangent {
  template <class T>
  using PerNode = std::array<T, max_patch_nodes>;  ///< one per node of the patch

  PerNode<Tensor<dim>> force_by_x, force_by_X;
  Vector<dim> force_by_lambda, force_by_w;
  Vector<dim> constraint_by_x;  ///< of the node itself
  double constraint_by_lambda, constraint_by_w;
  PerNode<Tensor<dim>> velocity_by_x, velocity_by_X;
  Vector<dim> velocity_by_lambda, velocity_by_w;

  ContactNodeTangent(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                     const ContactInput<dim>& at, const NodeBranch& branch = {});
};

// ---- templates on the scalar
// ---------------------------------------------------------------------

/// The derivative of the body's volume by the node's position [length^(dim-1)], along the
/// directions in which its shape may move.
template <int dim, class Scalar>
Vector<dim, Scalar> free_volume_gradient(const ContactPatch<dim>& patch,
                                         const PatchNodal<dim, Scalar>& X) {
  Vector<dim, Scalar> a = Vector<dim, Scalar>::Zero();
  for (const auto* corners : {&patch.corners, &patch.corners_beyond})
    for (const auto& corner : *corners) a += corner_volume_gradient<dim, Scalar>(corner, X);
  return patch.shape_free.template cast<Scalar>() * a;
}

/// Whether the volume that a node removes determines how far it moves, from |a|^2.
inline bool determines_motion(double square, double area) {
  return square > 1e-8 * area * area;
}

/// Throws RecoverableError where a closed node has several normals.
template <int dim>
void require_normal(const ContactPatch<dim>& patch, const SignedDistance<dim>& distance);

/// Throws RecoverableError if a node that may move has no direction of wear.
template <int dim>
void require_direction(const ContactPatch<dim>& patch, const Vector<dim>& normal);

/// p, v, h and q of a contact node.
template <int dim, class Scalar>
Vector<4, Scalar> wear_variables(const ContactPatch<dim>& patch,
                                 const ContactInput<dim, Scalar>& at, double friction,
                                 const Scalar& pressure, const Scalar& speed) {
  const Vector<dim, Scalar> d =
      at.X.row(0).transpose() - patch.initial_position.template cast<Scalar>();
  const Scalar depth = -d.dot(patch.initial_normal.template cast<Scalar>());
  return {pressure, speed, depth, Scalar(Scalar(friction) * pressure * speed)};
}

template <int dim>
WearInput wear_input(const ContactPatch<dim>& patch, const Vector<4>& variables,
                     const WearMoment& moment) {
  WearInput input{.pressure = variables[0],
                  .speed = variables[1],
                  .depth = variables[2],
                  .friction_power = variables[3],
                  .moment = moment};
  std::copy(patch.initial_position.begin(), patch.initial_position.end(), input.initial.begin());
  return input;
}

template <int dim, class Scalar>
NodalSurface<dim, Scalar>::NodalSurface(const ContactPatch<dim>& patch,
                                        const PatchNodal<dim, Scalar>& X, NormalRule rule) {
  area = Scalar(0);
  normal.setZero();
  const bool conserves = rule == NormalRule::conservative;
  for (const auto& corner : patch.corners) {
    const Vector<dim, Scalar> S = corner_area_vector<dim, Scalar>(corner, X);
    const Scalar size = S.norm();
    area += Scalar(corner.share) * size;
    if (!conserves) normal += Scalar(corner.initial_area / patch.initial_area) * S / size;
  }
  if (rule == NormalRule::normalised) normal /= Scalar(normal.norm());
  if (!conserves) return;
  const Vector<dim, Scalar> a = free_volume_gradient<dim, Scalar>(patch, X);
  if (const Scalar square = a.squaredNorm(); determines_motion(plain(square), plain(area)))
    normal = Scalar(area / square) * a;
}

template <int dim, class Scalar>
ContactNode<dim, Scalar>::ContactNode(const ContactParameters<dim>& parameters,
                                      const ContactPatch<dim>& patch,
                                      const ContactInput<dim, Scalar>& at,
                                      const NodeBranch& branch) {
  const CounterBody<dim>& body = parameters.counter_body;
  const NodalSurface<dim, Scalar> surface(patch, at.X, parameters.normal_rule);
  const PatchNodal<dim, Scalar> x = at.X + at.u;
  const Vector<dim, Scalar> seen =
      body.template seen<Scalar>(Vector<dim, Scalar>(x.row(0).transpose()), at.w);
  const SignedDistance<dim> distance = body.distance(plain<dim, Scalar>(seen), at.moment.time);
  const auto n = lift<dim, Scalar>(distance.normal, distance.normal_by_x, seen);
  gap = lift<dim, Scalar>(distance.gap, distance.normal, seen);
  const UnilateralContact<Scalar> contact(at.lambda, gap, parameters.rho, branch.contact);
  const Sliding<dim, Scalar> sliding(
      streaming_velocity<dim, Scalar>(patch, at.X, x, parameters.streaming) -
          body.motion.template at<Scalar>(seen),
      n, body.motion.template across_at<Scalar>(seen), velocity_variance<dim>(patch, body.motion));
  active = contact.active;
  normal = distance.normal;
  if (active) require_normal(patch, distance);
  traction = contact.traction;
  area = surface.area;
  force = (area * traction) * (n - Scalar(parameters.friction) * sliding.direction);
  constraint = contact.constraint;
  wear_rate = Scalar(0);
  if (active) {  // an open node does not wear
    const Vector<4, Scalar> input = wear_variables<dim, Scalar>(patch, at, parameters.friction,
                                                                Scalar(-traction), sliding.speed);
    const WearRate rate =
        parameters.wear.rate(wear_input(patch, plain<4, Scalar>(input), at.moment), branch.wear);
    wear_rate = lift<4, Scalar>(
        rate.value, {rate.by_pressure, rate.by_speed, rate.by_depth, rate.by_friction_power},
        input);
    require_direction(patch, plain<dim, Scalar>(surface.normal));
  }
  velocity = -wear_rate * (patch.shape_free.template cast<Scalar>() * surface.normal);
}

}  // namespace gnomon
