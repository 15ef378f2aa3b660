// One contact node in one phase of a path, or in steady rolling, with friction that may stick
// (docs/fretting.md, docs/rolling.md).
//
// The slip is the change of the tangential place of the body on its partner since the phase before,
//
//   Delta = P Q (r - r_before),   P = 1 - n n'
//
// with r and the rotation Q of path_of_partner.hpp. In rolling, material comes from upstream in an
// interval dt, in which the partner goes on by
//
//   r = u - dt (v^2 - |V| sum_k xi_k e_k),   Q = 1
//
// with unknown creepages xi_k along e_k, in space also about an axis, where e_k = W (X - centre);
// with small strains the body streams as far as v^2 dt, both are left out, and r - r_before is
// projected on the undeformed surface first. T follows from lambda_T and Delta
// (laws/stick_friction.hpp). The rows of the multipliers make them equal to lambda_eff and T, so
// that the force needs no more than
//
//   force = A (lambda n + lambda_T)      row of u
//   Wdot  = Wdot(p, v),  p the mean of this phase and the one before,  v = |Delta| / interval
//
// where it does not stick; what else a node has is that of contact_node.hpp. In rolling a law may
// read the mean m of q over the contact, an unknown with the row
//
//   sum A (s m - q) = 0
//
// with the share s of a node that counts as in contact (laws/contact_share.hpp).
#pragma once

#include <gnomon/laws/contact_share.hpp>
#include <gnomon/laws/friction_factor.hpp>
#include <gnomon/laws/stick_friction.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/path_of_partner.hpp>
#include <gnomon/terms/rolling.hpp>

namespace gnomon {

/// v^2 of a partner in rolling: |V| along its surface.
template <int dim, class Scalar>
Vector<dim, Scalar> rolling_velocity(const Rolling<dim>& rolling,
                                     const ContactKinematics<dim, Scalar>& met) {
  Vector<dim, Scalar> V = rolling.velocity.template cast<Scalar>();
  const Vector<dim, Scalar> along = V - met.normal * met.normal.dot(V);
  using std::sqrt;
  const Scalar square = along.squaredNorm();
  if (!(square > Scalar(0))) return V;
  return along * Scalar(Scalar(rolling.velocity.norm()) / sqrt(square));
}

/// Constants of all contact nodes in a phase.
template <int dim>
struct StickParameters {
  ContactParameters<dim> contact;
  double rho = 1;                ///< of the tangential multiplier [stress / length]
  double share = 1;              ///< StickingFriction::share
  bool shape_is_unknown = true;  ///< else a node may touch where it could not wear
  FrictionFactor factor{};       ///< of contact.friction
  PathOfPartner<dim> path{};
  std::optional<Rolling<dim>> rolling{};
};

template <int dim, class Scalar = double>
struct StickInput {
  ContactInput<dim, Scalar> contact;
  Vector<dim, Scalar> traction;  ///< lambda_T [stress]
  Vector<dim, Scalar> before;    ///< r of the phase before [length]
  Scalar lambda_before;          ///< the contact multiplier of that phase [stress]
  double interval = 1;           ///< since the phase before [time]
  bool rubs = true;              ///< else it has no friction: where it comes from is not known
};

struct StickBranch {
  NodeBranch contact = {};
  std::optional<bool> sticks = {};
};

/// Residual of a node.
template <int dim, class Scalar = double>
struct StickNode {
  ContactNode<dim, Scalar> contact;  ///< all that a contact node has
  Vector<dim, Scalar> constraint;    ///< C of lambda_T [length]
  Vector<dim, Scalar> place;         ///< r [length]
  std::array<double, 2> switching;   ///< lambda + rho g, |T^| - r
  Vector<6, Scalar> wear;            ///< wear_variables()
  Scalar lacks{0};                   ///< A (s m - q) [force length / time]

  StickNode(const StickParameters<dim>& parameters, const ContactPatch<dim>& patch,
            const StickInput<dim, Scalar>& at, const StickBranch& branch = {});
};

/// How the body slides at a node where an unknown creepage is one.
template <int dim>
Vector<dim> creeping_at(const CounterBody<dim>& partner, const Guide<dim>& guide,
                        const ContactPatch<dim>& patch) {
  return guide.creeping_at(patch.initial_position - partner.position);
}

/// G of an unknown of the partner; of a creepage its direction.
template <int dim, class Scalar>
Vector<dim, Scalar> along_guide(const ContactParameters<dim>& of, const ContactPatch<dim>& patch,
                                const ContactKinematics<dim, Scalar>& met, Eigen::Index k) {
  const Guide<dim>& guide = of.counter_body.guides[static_cast<std::size_t>(k)];
  if (guide.creeps()) return creeping_at(of.counter_body, guide, patch).template cast<Scalar>();
  const Vector<dim> G = met.partner.weights.col(k);
  const auto& by = met.partner.weights_by[static_cast<std::size_t>(k)];
  return by.size() > 0 ? lift(G, by, met.z) : Vector<dim, Scalar>(G.template cast<Scalar>());
}

/// r in rolling.
template <int dim, class Scalar>
Vector<dim, Scalar> place_in_rolling(const Rolling<dim>& rolling, const StickInput<dim, Scalar>& at,
                                     const CounterBody<dim>& partner,
                                     const ContactPatch<dim>& patch,
                                     const ContactKinematics<dim, Scalar>& met) {
  Vector<dim, Scalar> place = at.contact.u.row(0).transpose();
  if (!rolling.linear) place -= Scalar(at.interval) * rolling_velocity(rolling, met);
  const double passed = at.interval * rolling.velocity.norm();
  for (Eigen::Index k = 0; k < at.contact.q.size(); ++k)
    if (const Guide<dim>& guide = partner.guides[static_cast<std::size_t>(k)]; guide.creeps())
      place += Vector<dim>(creeping_at(partner, guide, patch) * guide.creepage(passed))
                   .template cast<Scalar>() *
               at.contact.q[k];
  return place;
}

/// Since the phase before, in space, before it is projected.
template <int dim, class Scalar>
Vector<dim, Scalar> change_of_place(const StickParameters<dim>& parameters,
                                    const ContactPatch<dim>& patch,
                                    const StickInput<dim, Scalar>& at,
                                    const Vector<dim, Scalar>& place) {
  Vector<dim, Scalar> change = place - at.before;
  if (!parameters.rolling) return parameters.path.in_space(change);
  if (!parameters.rolling->linear) return change;
  const Vector<dim, Scalar> N =
      Vector<dim>(patch.initial_normal.normalized()).template cast<Scalar>();
  return change - N * N.dot(change);
}

/// Coulomb's coefficient at the node.
template <int dim, class Scalar>
Scalar friction_at(const StickParameters<dim>& parameters, const ContactPatch<dim>& patch,
                   const ContactInput<dim, Scalar>& at) {
  const double coefficient = parameters.contact.friction;
  if (!parameters.factor.varies()) return Scalar(coefficient);
  const Scalar depth = worn_depth<dim, Scalar>(patch, at.X);
  const auto factor =
      parameters.factor.at(plain(depth), at.moment, initial_position_of<dim>(patch));
  return Scalar(coefficient) *
         lift(factor.value, Vector<1>(factor.by_depth), Vector<1, Scalar>(depth));
}

template <int dim, class Scalar>
StickNode<dim, Scalar>::StickNode(const StickParameters<dim>& parameters,
                                  const ContactPatch<dim>& patch, const StickInput<dim, Scalar>& at,
                                  const StickBranch& branch) {
  using std::sqrt;
  const ContactParameters<dim>& of = parameters.contact;
  const ContactKinematics<dim, Scalar> met(of, patch, at.contact, branch.contact);
  const NodalSurface<dim, Scalar> surface(patch, at.contact.X, of.normal_rule);
  if (met.contact.active) require_normal(patch, met.partner);
  const std::vector<Guide<dim>>& guides = of.counter_body.guides;
  const Vector<dim, Scalar> X = at.contact.X.row(0).transpose(),
                            u = at.contact.u.row(0).transpose();
  place = parameters.rolling
              ? place_in_rolling(*parameters.rolling, at, of.counter_body, patch, met)
              : parameters.path.place(parameters.path.now, guides, at.contact.q, X, u);
  const Vector<dim, Scalar> moved = change_of_place(parameters, patch, at, place);
  Vector<dim, Scalar> slip = moved - met.normal * met.normal.dot(moved);
  if (!at.rubs) slip.setZero();  // by no place before
  const Scalar coefficient = friction_at(parameters, patch, at.contact);
  const StickFriction<dim, Scalar> friction(
      at.traction, slip, met.normal, Scalar(-coefficient * met.contact.traction), parameters.rho,
      met.contact.active && at.rubs && plain(coefficient) > 0, branch.sticks);
  constraint = friction.constraint;
  switching = {plain(Scalar(at.contact.lambda + Scalar(of.rho) * met.gap)), friction.excess};

  contact.gap = met.gap;
  contact.active = met.contact.active;
  contact.normal = met.partner.normal;
  contact.traction = met.contact.traction;
  contact.area = contact.share = surface.area;
  contact.load = -surface.area * met.contact.traction;
  contact.force = surface.area * (at.contact.lambda * met.normal + at.traction);
  contact.constraint = met.contact.constraint;
  contact.partner.resize(at.contact.q.size());
  for (Eigen::Index k = 0; k < at.contact.q.size(); ++k)
    contact.partner[k] = -along_guide<dim>(of, patch, met, k).dot(contact.force);
  contact.slip = slip;
  contact.friction = plain(coefficient);
  contact.sticks = friction.sticks;

  const Scalar square = slip.squaredNorm();
  Scalar speed(0), pressure = Scalar(-0.5) * met.contact.traction;
  if (!friction.sticks && square > Scalar(0)) speed = sqrt(square) / Scalar(at.interval);
  if (at.lambda_before < Scalar(0)) pressure -= Scalar(0.5) * at.lambda_before;
  const ContactShare known(plain(pressure), of.full_pressure);
  const Scalar share = lift(known.value, Vector<1>(known.by_pressure), Vector<1, Scalar>(pressure));
  wear = wear_variables<dim, Scalar>(patch, at.contact, coefficient, pressure, speed, share);
  contact.wear_rate = Scalar(0);
  if (plain(pressure) > 0) {
    const WearRate rate =
        of.wear.rate(wear_input(patch, plain(wear), at.contact.moment), branch.contact.wear);
    contact.wear_rate = Scalar(parameters.share) * lift(rate.value, gradient(rate), wear);
    // A node that has just opened wears by a pressure that may be no more than a rounding error.
    if (rate.value != 0 && contact.active && parameters.shape_is_unknown)
      require_direction(patch, plain(surface.normal));
  }
  contact.velocity =
      -contact.wear_rate * (patch.shape_free.template cast<Scalar>() * surface.normal);
  lacks =
      surface.area * Scalar((share + Scalar(mean_of_nothing)) * at.contact.mean_power - wear[3]);
}

}  // namespace gnomon
