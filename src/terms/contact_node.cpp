#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/base/error.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/surface_derivative.hpp>

namespace gnomon {

namespace {

/// Derivatives of the traction per nominal area, tau = lambda_eff (n - friction s), and of the
/// sliding speed, with respect to the partner's normal, the relative velocity and its part out of
/// the plane, at constant lambda_eff.
template <int dim>
struct TractionDerivative {
  Vector<dim> direction;  // tau / lambda_eff
  Tensor<dim> by_normal, by_velocity;
  Vector<dim> by_across;
  Vector<dim> speed_by_normal, speed_by_velocity;
  double speed_by_across;

  TractionDerivative(const ContactKinematics<dim>& met, double friction) {
    const Vector<dim>& n = met.normal;
    const double traction = met.contact.traction, speed = met.sliding.speed;
    const Tensor<dim> tangential = Tensor<dim>::Identity() - n * n.transpose();
    const Tensor<dim> v_by_n =
        -(n.dot(met.relative) * Tensor<dim>::Identity() + n * met.relative.transpose());
    const Vector<dim>& s = met.sliding.direction;
    direction = n - friction * s;
    speed_by_normal = v_by_n.transpose() * s;
    speed_by_velocity = tangential * s;
    speed_by_across = met.partner.across == 0 ? 0 : met.partner.across / speed;
    by_normal = traction * Tensor<dim>::Identity();
    by_velocity.setZero();
    by_across.setZero();
    if (friction == 0 || speed == 0) return;
    const Tensor<dim> turn =
        -friction * traction / speed * (Tensor<dim>::Identity() - s * s.transpose());
    by_normal += turn * v_by_n;
    by_velocity = turn * tangential;
    by_across = friction * traction / speed * speed_by_across * s;
  }
};

}  // namespace

template <int dim>
void require_normal(const ContactPatch<dim>& patch, const Partner<dim>& partner) {
  if (!partner.unique)
    throw RecoverableError(fmt::format(
        "contact node {} touches the counter-body where several points of its surface are equally "
        "near, so that it has no normal",
        patch.node));
}

template <int dim>
void require_direction(const ContactPatch<dim>& patch, const Vector<dim>& normal) {
  if (normal.isZero(0) && patch.may_move())
    throw RecoverableError(fmt::format(
        "wear.normal = \"conservative\": the contact node at ({:.4g}) cannot wear, because the "
        "motion that its shape is allowed does not change the volume of the body; contact may have "
        "reached an end of the wearing surface",
        fmt::join(patch.initial_position, ", ")));
}

template <int dim>
void contact_switching(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                       const ContactInput<dim>& at, const NodeBranch& branch,
                       std::span<double> values) {
  const ContactKinematics<dim> met(parameters, patch, at, branch);
  values[0] = at.lambda + parameters.rho * met.gap;
  if (values.size() == 1) return;
  parameters.wear.switching(wear_input(patch, met.wear, at.moment), values.subspan(1), branch.wear);
}

template <int dim>
ContactNodeTangent<dim>::ContactNodeTangent(const ContactParameters<dim>& parameters,
                                            const ContactPatch<dim>& patch,
                                            const ContactInput<dim>& at, const NodeBranch& branch) {
  const NodalSurface<dim> surface(patch, at.X, parameters.normal_rule);
  const SurfaceDerivative<dim> derivative(patch, at.X, parameters.normal_rule);
  const ContactKinematics<dim> met(parameters, patch, at, branch);
  const Partner<dim>& partner = met.partner;
  const UnilateralContact<double>& contact = met.contact;
  const TractionDerivative<dim> traction(met, parameters.friction);
  const WearRate wear =
      contact.active ? parameters.wear.rate(wear_input(patch, met.wear, at.moment), branch.wear)
                     : WearRate{};
  // q = mu p v is resolved by the chain rule.
  const double q_by_p = parameters.friction * met.sliding.speed,
               q_by_speed = parameters.friction * met.wear[0];
  const double rate_by_traction = -(wear.by_pressure + q_by_p * wear.by_friction_power),
               rate_by_speed = wear.by_speed + q_by_speed * wear.by_friction_power;
  if (contact.active) require_normal(patch, partner);

  // What depends on the partner, by the node's position and then the partner's unknowns.
  const Tensor<dim> force_by_v = surface.area * traction.by_velocity;
  const Columns force_by_z =
      surface.area *
          (contact.traction_by_gap * traction.direction * partner.gap_by +
           traction.by_normal * partner.normal_by + traction.by_across * partner.across_by) -
      force_by_v * partner.velocity_by;
  const Row rate_by_z =
      rate_by_traction * contact.traction_by_gap * partner.gap_by +
      rate_by_speed * (traction.speed_by_normal.transpose() * partner.normal_by +
                       traction.speed_by_across * partner.across_by -
                       traction.speed_by_velocity.transpose() * partner.velocity_by);
  const Vector<dim> N = patch.shape_free * surface.normal;
  const Eigen::Index unknowns = partner.unknowns();
  constraint_by_x = contact.constraint_by_gap * partner.normal;
  constraint_by_lambda = contact.constraint_by_lambda;
  constraint_by_q = contact.constraint_by_gap * partner.gap_by.tail(unknowns);
  force_by_lambda = surface.area * contact.traction_by_lambda * traction.direction;
  force_by_q = force_by_z.rightCols(unknowns);
  velocity_by_lambda = -rate_by_traction * contact.traction_by_lambda * N;
  velocity_by_q = -N * rate_by_z.tail(unknowns);
  weights = partner.weights;
  const Vector<dim> force = surface.area * contact.traction * traction.direction;
  for (Eigen::Index k = 0; k < unknowns; ++k)
    if (const Columns& by = partner.weights_by[k]; by.size() > 0)
      partner_by[k] = -force.transpose() * by;
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p].setZero();
    velocity_by_x[p].setZero();
    force_by_X[p] = contact.traction * traction.direction * derivative.area[p].transpose();
    velocity_by_X[p] = -wear.value * patch.shape_free * derivative.normal[p];
  }
  force_by_x[0] = force_by_z.template leftCols<dim>();
  velocity_by_x[0] = -N * rate_by_z.template head<dim>();
  velocity_by_X[0] += wear.by_depth * N * patch.initial_normal.transpose();

  if (parameters.streaming.isZero(0)) return;
  const StreamingVelocityDerivative<dim> change(patch, at.X, met.x, parameters.streaming);
  const Tensor<dim> velocity_by_v = -rate_by_speed * N * traction.speed_by_velocity.transpose();
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p] += force_by_v * change.by_x[p];
    force_by_X[p] += force_by_v * change.by_X[p];
    velocity_by_x[p] += velocity_by_v * change.by_x[p];
    velocity_by_X[p] += velocity_by_v * change.by_X[p];
  }
}

template void require_normal(const ContactPatch<2>&, const Partner<2>&);
template void require_normal(const ContactPatch<3>&, const Partner<3>&);
template void require_direction(const ContactPatch<2>&, const Vector<2>&);
template void require_direction(const ContactPatch<3>&, const Vector<3>&);
template void contact_switching(const ContactParameters<2>&, const ContactPatch<2>&,
                                const ContactInput<2>&, const NodeBranch&, std::span<double>);
template void contact_switching(const ContactParameters<3>&, const ContactPatch<3>&,
                                const ContactInput<3>&, const NodeBranch&, std::span<double>);
template struct ContactNodeTangent<2>;
template struct ContactNodeTangent<3>;

}  // namespace gnomon
