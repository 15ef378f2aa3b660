#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/mesh/corner_derivatives.hpp>
#include <gnomon/terms/contact_node.hpp>

namespace gnomon {

namespace {

/// dA/dX (rows) and dN/dX of every patch node.
template <int dim>
struct SurfaceDerivative {
  std::array<Vector<dim>, max_patch_nodes> area;
  std::array<Tensor<dim>, max_patch_nodes> normal;

  SurfaceDerivative(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, NormalRule rule) {
    const std::size_t count = patch.nodes.size();
    for (std::size_t p = 0; p < count; ++p) area[p].setZero(), normal[p].setZero();
    const bool conserves = rule == NormalRule::conservative;
    Vector<dim> mean = Vector<dim>::Zero();
    double total = 0;
    for (const auto& corner : patch.corners) {
      const Vector<dim> S = corner_area_vector<dim, double>(corner, X);
      const double size = S.norm();
      const Vector<dim> N = S / size;
      const double weight = corner.initial_area / patch.initial_area;
      total += corner.share * size;
      mean += weight * N;
      const Tensor<dim> tangential = (Tensor<dim>::Identity() - N * N.transpose()) * weight / size;
      const auto dS = area_vector_derivative<dim>(corner, X);
      for (int k = 0; k < dim; ++k) {
        area[corner.nodes[k]] += corner.share * dS[k].transpose() * N;
        if (!conserves) normal[corner.nodes[k]] += tangential * dS[k];
      }
    }
    if (conserves) conserve(patch, X, total);
    if (rule != NormalRule::normalised) return;
    const double length = mean.norm();
    const Vector<dim> unit = mean / length;
    const Tensor<dim> project = (Tensor<dim>::Identity() - unit * unit.transpose()) / length;
    for (std::size_t p = 0; p < count; ++p) normal[p] = project * normal[p];
  }

private:
  /// For N = A a/|a|^2: dN = a/|a|^2 dA + A/|a|^2 (1 - 2 a a'/|a|^2) da.
  void conserve(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, double total) {
    const Vector<dim> a = free_volume_gradient<dim, double>(patch, X);
    const double square = a.squaredNorm();
    if (!determines_motion(square, total)) return;
    Tensor<dim> by_a = total / square * (Tensor<dim>::Identity() - 2 / square * a * a.transpose());
    by_a *= patch.shape_free;
    for (const auto* corners : {&patch.corners, &patch.corners_beyond})
      for (const auto& corner : *corners) {
        const auto da = volume_gradient_derivative<dim>(corner, X);
        for (std::size_t k = 0; k < da.size(); ++k) normal[corner.nodes[k]] += by_a * da[k];
      }
    for (std::size_t p = 0; p < patch.nodes.size(); ++p)
      normal[p] += a / square * area[p].transpose();
  }
};

/// Derivatives of the traction per nominal area, tau = lambda_eff (n - friction s), and of the
/// sliding speed, with respect to the node's position relative to the counter-body, its relative
/// velocity and lambda_eff.
template <int dim>
struct TractionDerivative {
  Vector<dim> direction;    // tau / lambda_eff
  Tensor<dim> by_position;  // at constant lambda_eff and velocity
  Tensor<dim> by_velocity;  // at constant lambda_eff
  Vector<dim> speed_by_position, speed_by_velocity;

  TractionDerivative(const Vector<dim>& n, const Tensor<dim>& n_by_x, const Vector<dim>& relative,
                     const Sliding<dim>& sliding, double friction, double traction) {
    const Tensor<dim> tangential = Tensor<dim>::Identity() - n * n.transpose();
    const Tensor<dim> v_by_x =
        -(n.dot(relative) * Tensor<dim>::Identity() + n * relative.transpose()) * n_by_x;
    const Vector<dim>& s = sliding.direction;
    direction = n - friction * s;
    speed_by_position = v_by_x.transpose() * s;
    speed_by_velocity = tangential * s;
    by_position = traction * n_by_x;
    by_velocity.setZero();
    if (friction == 0 || sliding.speed == 0) return;
    const Tensor<dim> turn =
        -friction * traction / sliding.speed * (Tensor<dim>::Identity() - s * s.transpose());
    by_position += turn * v_by_x;
    by_velocity = turn * tangential;
    friction_traction = friction * traction;
  }

  /// The speed has a part out of the plane that depends on the position, too.
  void slide_across(const Sliding<dim>& sliding, double across, const Vector<dim>& across_by_x) {
    const Vector<dim> by_x = across / sliding.speed * across_by_x;
    speed_by_position += by_x;
    by_position += friction_traction / sliding.speed * sliding.direction * by_x.transpose();
  }

private:
  double friction_traction = 0;
};

/// Wdot and its derivatives with respect to the variables of a contact node; q = mu p v is resolved
/// by the chain rule.
struct NodalWear {
  double rate = 0, by_traction = 0, by_speed = 0, by_depth = 0;
};

template <int dim>
NodalWear nodal_wear(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                     const ContactInput<dim>& at, const UnilateralContact<double>& contact,
                     double speed, const NodeBranch& branch) {
  if (!contact.active) return {};
  const double mu = parameters.friction, p = -contact.traction;
  const Vector<4> input = wear_variables<dim, double>(patch, at, mu, p, speed);
  const WearRate rate = parameters.wear.rate(wear_input(patch, input, at.moment), branch.wear);
  return {.rate = rate.value,
          .by_traction = -(rate.by_pressure + mu * speed * rate.by_friction_power),
          .by_speed = rate.by_speed + mu * p * rate.by_friction_power,
          .by_depth = rate.by_depth};
}

}  // namespace

template <int dim>
void require_normal(const ContactPatch<dim>& patch, const SignedDistance<dim>& distance) {
  if (!distance.unique)
    throw RecoverableError(fmt::format(
        "contact node {} touches the counter-body where several points of its surface are equally "
        "near, so that it has no normal",
        patch.node));
}

template <int dim>
void require_direction(const ContactPatch<dim>& patch, const Vector<dim>& normal) {
  if (normal.isZero(0) && patch.may_move())
    throw RecoverableError(fmt::format(
        "wear.normal = \"conservative\": contact node {} cannot wear, because the motion that its "
        "supports allow does not change the volume of the body; contact may have reached an end of "
        "the "
        "wearing surface",
        patch.node));
}

template <int dim>
void contact_switching(const ContactParameters<dim>& parameters, const ContactPatch<dim>& patch,
                       const ContactInput<dim>& at, const NodeBranch& branch,
                       std::span<double> values) {
  const CounterBody<dim>& body = parameters.counter_body;
  const PatchNodal<dim> x = at.X + at.u;
  const Vector<dim> seen = body.seen(Vector<dim>(x.row(0).transpose()), at.w);
  const SignedDistance<dim> distance = body.distance(seen, at.moment.time);
  values[0] = at.lambda + parameters.rho * distance.gap;
  if (values.size() == 1) return;
  const UnilateralContact<double> contact(at.lambda, distance.gap, parameters.rho, branch.contact);
  const Sliding<dim> sliding(
      streaming_velocity<dim, double>(patch, at.X, x, parameters.streaming) - body.motion.at(seen),
      distance.normal, body.motion.across_at(seen), velocity_variance(patch, body.motion));
  const Vector<4> input =
      wear_variables<dim, double>(patch, at, parameters.friction, -contact.traction, sliding.speed);
  parameters.wear.switching(wear_input(patch, input, at.moment), values.subspan(1), branch.wear);
}

template <int dim>
ContactNodeTangent<dim>::ContactNodeTangent(const ContactParameters<dim>& parameters,
                                            const ContactPatch<dim>& patch,
                                            const ContactInput<dim>& at, const NodeBranch& branch) {
  const CounterBody<dim>& body = parameters.counter_body;
  const NodalSurface<dim> surface(patch, at.X, parameters.normal_rule);
  const SurfaceDerivative<dim> derivative(patch, at.X, parameters.normal_rule);
  const PatchNodal<dim> x = at.X + at.u;
  const Vector<dim> seen = body.seen(Vector<dim>(x.row(0).transpose()), at.w);
  const SignedDistance<dim> distance = body.distance(seen, at.moment.time);
  const Vector<dim>& n = distance.normal;
  const UnilateralContact<double> contact(at.lambda, distance.gap, parameters.rho, branch.contact);
  const Vector<dim> relative =
      streaming_velocity<dim, double>(patch, at.X, x, parameters.streaming) - body.motion.at(seen);
  const double across = body.motion.across_at(seen);
  const Sliding<dim> sliding(relative, n, across, velocity_variance(patch, body.motion));
  TractionDerivative<dim> traction(n, distance.normal_by_x, relative, sliding, parameters.friction,
                                   contact.traction);
  if (across != 0) traction.slide_across(sliding, across, body.motion.across_by_x);
  const NodalWear wear = nodal_wear(parameters, patch, at, contact, sliding.speed, branch);
  if (contact.active) require_normal(patch, distance), require_direction(patch, surface.normal);

  // The part that depends on the node's position relative to the counter-body, whose surface
  // velocity may vary with the position.
  const Tensor<dim> force_by_v = surface.area * traction.by_velocity;
  const Tensor<dim> force_by_seen =
      surface.area *
          (contact.traction_by_gap * traction.direction * n.transpose() + traction.by_position) -
      force_by_v * body.motion.spin;
  const Vector<dim> rate_by_seen =
      wear.by_traction * contact.traction_by_gap * n +
      wear.by_speed *
          (traction.speed_by_position - body.motion.spin.transpose() * traction.speed_by_velocity);
  constraint_by_x = contact.constraint_by_gap * n;
  constraint_by_lambda = contact.constraint_by_lambda;
  constraint_by_w = -constraint_by_x.dot(body.approach);
  force_by_lambda = surface.area * contact.traction_by_lambda * traction.direction;
  force_by_w = -force_by_seen * body.approach;
  const Vector<dim> N = patch.shape_free * surface.normal;
  velocity_by_lambda = -wear.by_traction * contact.traction_by_lambda * N;
  velocity_by_w = N * rate_by_seen.dot(body.approach);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p].setZero();
    velocity_by_x[p].setZero();
    force_by_X[p] = contact.traction * traction.direction * derivative.area[p].transpose();
    velocity_by_X[p] = -wear.rate * patch.shape_free * derivative.normal[p];
  }
  force_by_x[0] = force_by_seen;
  velocity_by_x[0] = -N * rate_by_seen.transpose();
  velocity_by_X[0] += wear.by_depth * N * patch.initial_normal.transpose();

  if (parameters.streaming.isZero(0)) return;
  const StreamingVelocityDerivative<dim> change(patch, at.X, x, parameters.streaming);
  const Tensor<dim> velocity_by_v = -wear.by_speed * N * traction.speed_by_velocity.transpose();
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p] += force_by_v * change.by_x[p];
    force_by_X[p] += force_by_v * change.by_X[p];
    velocity_by_x[p] += velocity_by_v * change.by_x[p];
    velocity_by_X[p] += velocity_by_v * change.by_X[p];
  }
}

template void require_normal(const ContactPatch<2>&, const SignedDistance<2>&);
template void require_normal(const ContactPatch<3>&, const SignedDistance<3>&);
template void require_direction(const ContactPatch<2>&, const Vector<2>&);
template void require_direction(const ContactPatch<3>&, const Vector<3>&);
template void contact_switching(const ContactParameters<2>&, const ContactPatch<2>&,
                                const ContactInput<2>&, const NodeBranch&, std::span<double>);
template void contact_switching(const ContactParameters<3>&, const ContactPatch<3>&,
                                const ContactInput<3>&, const NodeBranch&, std::span<double>);
template struct ContactNodeTangent<2>;
template struct ContactNodeTangent<3>;

}  // namespace gnomon
