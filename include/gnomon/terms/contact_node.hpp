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
//   partner    = -G' force                    rows of the partner's unknowns q (partner.hpp)
//
// v_T is the tangential part of F V - v^2 and |v_T| the speed (sliding.hpp), n the normal of the
// partner, Wdot the rate of the wear law, N a normal by one of the rules of nodal_surface.hpp, P
// the projector on the directions in which the shape may move.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/base/lift.hpp>
#include <gnomon/laws/unilateral_contact.hpp>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/terms/nodal_surface.hpp>
#include <gnomon/terms/sliding.hpp>
#include <span>

namespace gnomon {

/// Constants of all contact nodes.
template <int dim>
struct ContactParameters {
  CounterBody<dim> counter_body;
  WearLaw wear;
  double friction = 0;                          ///< Coulomb's coefficient mu of eq. (10)
  Vector<dim> streaming = Vector<dim>::Zero();  ///< V of eq. (7), along the surface [length / time]
  NormalRule normal_rule = NormalRule::averaged;
  double rho = 1;            ///< [stress / length]
  double full_pressure = 0;  ///< from which a node counts as in contact as a whole [stress]
};

/// The state of a contact node: everything that its residual depends on.
template <int dim, class Scalar = double>
struct ContactInput {
  PatchNodal<dim, Scalar> X;  ///< undeformed positions of patch.nodes [length]
  PatchNodal<dim, Scalar> u;  ///< their displacements [length]
  Scalar lambda;              ///< of the node itself [stress]
  PartnerMotion<Scalar> q{};  ///< of the partner
  WearMoment moment = {};     ///< read by the wear law, and by a counter-body that turns
  double clearance = 0;       ///< in a load ramp, a part of the gap [length]
  Scalar mean_power{0};       ///< q_mean of the wear law, in rolling [stress length / time]
};

/// The part of all nodes in the row of the mean of q over the closed ones, which has a solution
/// where nothing touches.
inline constexpr double mean_of_nothing = 1e-12;

/// The smooth branch of a contact node.
struct NodeBranch {
  Branch contact = Branch::by_sign;
  std::span<const char> wear = {};  ///< branches of the WearLaw

  NodeBranch(Branch branch = Branch::by_sign, std::span<const char> wear_branches = {})
      : contact(branch), wear(wear_branches) {}
};

/// What the partner of a node depends on: z = (x, q), as in Partner.
template <int dim, class Scalar>
using PartnerVariables = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, Partner<dim>::most, 1>;
template <int dim, class Scalar>
PartnerVariables<dim, Scalar> partner_variables(const Vector<dim, Scalar>& x,
                                                const PartnerMotion<Scalar>& q) {
  PartnerVariables<dim, Scalar> z(dim + q.size());
  z.template head<dim>() = x;
  z.tail(q.size()) = q;
  return z;
}

/// Where a contact node is and what it meets there: what its residual, its derivatives and its
/// switching functions are made from.
template <int dim, class Scalar = double>
struct ContactKinematics {
  PatchNodal<dim, Scalar> x;        ///< current positions of the patch [length]
  PartnerVariables<dim, Scalar> z;  ///< that of the node, and q
  Partner<dim> partner;             ///< with its derivatives, at the plain state
  Scalar gap;                       ///< g [length]
  Vector<dim, Scalar> normal;       ///< n
  Vector<dim, Scalar> relative;     ///< F V - v^2 [length / time]
  UnilateralContact<Scalar> contact;
  Sliding<dim, Scalar> sliding;
  Vector<6, Scalar> wear;  ///< wear_variables()

  ContactKinematics(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                    const ContactInput<dim, Scalar>& at, const NodeBranch& branch = {});
};

/// Residual of a contact node.
template <int dim, class Scalar = double>
struct ContactNode {
  Vector<dim, Scalar> force = Vector<dim, Scalar>::Zero();
  Scalar constraint{0};
  Vector<dim, Scalar> velocity = Vector<dim, Scalar>::Zero();
  PartnerMotion<Scalar> partner{};  ///< force on the partner in the rows of q
  Scalar wear_rate{0};              ///< Wdot [length / time]
  Scalar traction{0};               ///< lambda_eff [stress]
  Scalar area{0};                   ///< A; of a pair of bodies, that which the partner
                                    ///< covers, a tenth at least where it carries force
  Scalar load{0};  ///< - lambda_eff A; of a pair, by the node's own multiplier alone [force]
  Vector<dim, Scalar> own_force = Vector<dim, Scalar>::Zero();  ///< of a pair: that part of `force`
  Scalar share{0};                                              ///< the area that bears it
  Scalar gap{0};                                                ///< g [length]
  Vector<dim> normal = Vector<dim>::Zero();                     ///< n of the partner
  /// On the partner, in a phase; only where contact may stick (stick_node.hpp) [length].
  Vector<dim, Scalar> slip = Vector<dim, Scalar>::Zero();
  double friction = 0;  ///< its coefficient; only where contact may stick
  bool active = false;
  bool sticks = false;  ///< where it may

  ContactNode() = default;
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
/// undeformed positions X enter through area, normal and streaming. The rows of the partner are -G'
/// those of the force, and where G is not constant `partner_by` beside.
template <int dim>
struct ContactNodeTangent {
  template <class T>
  using PerNode = std::array<T, max_patch_nodes>;  ///< one per node of the patch
  using Row = typename Partner<dim>::Row;
  using Columns = typename Partner<dim>::Columns;

  PerNode<Tensor<dim>> force_by_x, force_by_X;
  Vector<dim> force_by_lambda;
  Columns force_by_q;
  Vector<dim> constraint_by_x;  ///< of the node itself
  double constraint_by_lambda;
  Row constraint_by_q;
  PerNode<Tensor<dim>> velocity_by_x, velocity_by_X;
  Vector<dim> velocity_by_lambda;
  Columns velocity_by_q;
  Columns weights;  ///< G
  /// -force' dG, by the node's own position and q: a row for each unknown, empty where G is
  /// constant.
  std::array<Row, most_partner_unknowns> partner_by;

  ContactNodeTangent(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                     const ContactInput<dim>& at, const NodeBranch& branch = {});
};

// ---- templates on the scalar
// ---------------------------------------------------------------------

/// Throws RecoverableError where a closed node has several normals.
template <int dim>
void require_normal(const ContactPatch<dim>& patch, const Partner<dim>& partner);

/// Throws RecoverableError if a node that may move has no direction of wear.
template <int dim>
void require_direction(const ContactPatch<dim>& patch, const Vector<dim>& normal);

/// h of a contact node [length].
template <int dim, class Scalar>
Scalar worn_depth(const ContactPatch<dim>& patch, const PatchNodal<dim, Scalar>& X) {
  const Vector<dim, Scalar> d =
      X.row(0).transpose() - patch.initial_position.template cast<Scalar>();
  return -d.dot(patch.initial_normal.template cast<Scalar>());
}

/// p, v, h, q, q_mean and s of a contact node.
template <int dim, class Scalar>
Vector<6, Scalar> wear_variables(const ContactPatch<dim>& patch,
                                 const ContactInput<dim, Scalar>& at, const Scalar& friction,
                                 const Scalar& pressure, const Scalar& speed, const Scalar& share) {
  Vector<6, Scalar> variables;
  variables << pressure, speed, worn_depth<dim, Scalar>(patch, at.X),
      Scalar(friction * pressure * speed), at.mean_power, share;
  return variables;
}

/// With zeros beyond `dim`.
template <int dim>
std::array<double, 3> initial_position_of(const ContactPatch<dim>& patch) {
  std::array<double, 3> result{};
  std::copy(patch.initial_position.begin(), patch.initial_position.end(), result.begin());
  return result;
}

template <int dim>
WearInput wear_input(const ContactPatch<dim>& patch, const Vector<6>& variables,
                     const WearMoment& moment) {
  return {.pressure = variables[0],
          .speed = variables[1],
          .depth = variables[2],
          .friction_power = variables[3],
          .mean_friction_power = variables[4],
          .contact_share = variables[5],
          .moment = moment,
          .initial = initial_position_of<dim>(patch)};
}

/// By wear_variables().
inline Vector<6> gradient(const WearRate& rate) {
  Vector<6> by;
  by << rate.by_pressure, rate.by_speed, rate.by_depth, rate.by_friction_power,
      rate.by_mean_friction_power, rate.by_contact_share;
  return by;
}

template <int dim, class Scalar>
ContactKinematics<dim, Scalar>::ContactKinematics(const ContactParameters<dim>& parameters,
                                                  const ContactPatch<dim>& patch,
                                                  const ContactInput<dim, Scalar>& at,
                                                  const NodeBranch& branch)
    : x(at.X + at.u),
      z(partner_variables<dim, Scalar>(x.row(0).transpose(), at.q)),
      partner(parameters.counter_body.meet(plain(Vector<dim, Scalar>(x.row(0).transpose())),
                                           plain(at.q), at.moment.time)),
      gap(lift(partner.gap, partner.gap_by, z) + Scalar(at.clearance)),
      normal(lift(partner.normal, partner.normal_by, z)),
      relative(streaming_velocity<dim, Scalar>(patch, at.X, x, parameters.streaming) -
               lift(partner.velocity, partner.velocity_by, z)),
      contact(at.lambda, gap, parameters.rho, branch.contact),
      sliding(relative, normal, lift(partner.across, partner.across_by, z),
              velocity_variance<dim>(patch, partner.velocity_by.template leftCols<dim>(),
                                     partner.across_by.template head<dim>().transpose())),
      wear(wear_variables<dim, Scalar>(patch, at, Scalar(parameters.friction),
                                       Scalar(-contact.traction), sliding.speed, Scalar(1))) {}

template <int dim, class Scalar>
ContactNode<dim, Scalar>::ContactNode(const ContactParameters<dim>& parameters,
                                      const ContactPatch<dim>& patch,
                                      const ContactInput<dim, Scalar>& at,
                                      const NodeBranch& branch) {
  const NodalSurface<dim, Scalar> surface(patch, at.X, parameters.normal_rule);
  const ContactKinematics<dim, Scalar> met(parameters, patch, at, branch);
  gap = met.gap;
  active = met.contact.active;
  normal = met.partner.normal;
  if (active) require_normal(patch, met.partner);
  traction = met.contact.traction;
  area = share = surface.area;
  load = -area * traction;
  force = (area * traction) * (met.normal - Scalar(parameters.friction) * met.sliding.direction);
  constraint = met.contact.constraint;
  partner.resize(at.q.size());
  for (Eigen::Index k = 0; k < at.q.size(); ++k) {
    Vector<dim, Scalar> G = met.partner.weights.col(k).template cast<Scalar>();
    if (const auto& by = met.partner.weights_by[k]; by.size() > 0)
      G = lift(Vector<dim>(met.partner.weights.col(k)), by, met.z);
    partner[k] = -G.dot(force);
  }
  wear_rate = Scalar(0);
  if (active) {  // an open node does not wear
    const WearRate rate =
        parameters.wear.rate(wear_input(patch, plain(met.wear), at.moment), branch.wear);
    wear_rate = lift(rate.value, gradient(rate), met.wear);
    if (rate.value != 0) require_direction(patch, plain(surface.normal));
  }
  velocity = -wear_rate * (patch.shape_free.template cast<Scalar>() * surface.normal);
}

}  // namespace gnomon
