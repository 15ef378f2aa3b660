#include <gnomon/terms/contact_node.hpp>

namespace gnomon {

namespace {

/// The skew matrix with skew(a) w = a x w.
Tensor<3> skew(const Vector<3>& a) {
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// dS/dX of the corner's nodes, in the order of corner.nodes.
template <int dim>
std::array<Tensor<dim>, dim> area_vector_derivative(
    const typename ContactPatch<dim>::Corner& corner, const PatchNodal<dim>& X) {
  if constexpr (dim == 2) {
    const Tensor<2> turn = corner.sign / 2 * Tensor<2>{{0, 1}, {-1, 0}};
    return {Tensor<2>(-turn), turn};
  } else {
    const Vector<3> a = (X.row(corner.nodes[1]) - X.row(corner.nodes[0])).transpose();
    const Vector<3> b = (X.row(corner.nodes[2]) - X.row(corner.nodes[0])).transpose();
    const Tensor<3> by_a = -skew(b) / 4;
    const Tensor<3> by_b = skew(a) / 4;
    return {Tensor<3>(-by_a - by_b), by_a, by_b};
  }
}

/// dA/dX (rows) and dN/dX of every patch node.
template <int dim>
struct SurfaceDerivative {
  std::array<Vector<dim>, max_patch_nodes> area;
  std::array<Tensor<dim>, max_patch_nodes> normal;

  SurfaceDerivative(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, NormalRule rule) {
    const std::size_t count = patch.nodes.size();
    for (std::size_t p = 0; p < count; ++p) area[p].setZero(), normal[p].setZero();
    Vector<dim> mean = Vector<dim>::Zero();
    for (const auto& corner : patch.corners) {
      const Vector<dim> S = corner_area_vector<dim, double>(corner, X);
      const double share = S.norm();
      const Vector<dim> N = S / share;
      const double weight = corner.initial_area / patch.initial_area;
      mean += weight * N;
      const Tensor<dim> tangential = (Tensor<dim>::Identity() - N * N.transpose()) * weight / share;
      const auto dS = area_vector_derivative<dim>(corner, X);
      for (int k = 0; k < dim; ++k) {
        area[corner.nodes[k]] += dS[k].transpose() * N;
        normal[corner.nodes[k]] += tangential * dS[k];
      }
    }
    if (rule == NormalRule::averaged) return;
    const double length = mean.norm();
    const Vector<dim> unit = mean / length;
    const Tensor<dim> project = (Tensor<dim>::Identity() - unit * unit.transpose()) / length;
    for (std::size_t p = 0; p < count; ++p) normal[p] = project * normal[p];
  }
};

/// The traction per nominal area, tau = lambda_eff (n - friction s), and the sliding speed, as
/// changes of the node's position as seen from the counter-body, of its relative velocity and of
/// lambda_eff.
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
  }
};

}  // namespace

template <int dim>
ContactNodeTangent<dim>::ContactNodeTangent(const ContactParameters<dim>& parameters,
                                            const ContactPatch<dim>& patch,
                                            const ContactInput<dim>& at, Branch branch) {
  const CounterBody<dim>& body = parameters.counter_body;
  const NodalSurface<dim> surface(patch, at.X, parameters.normal_rule);
  const SurfaceDerivative<dim> derivative(patch, at.X, parameters.normal_rule);
  const Vector<dim> seen_x = (at.X.row(0) + at.u.row(0)).transpose() - at.w * body.approach;
  const auto seen = body.project(seen_x);
  const Vector<dim>& n = seen.normal;
  const UnilateralContact<double> contact(at.lambda, seen.gap, parameters.rho, branch);
  const PatchNodal<dim> x = at.X + at.u;
  const Vector<dim> relative =
      relative_velocity<dim, double>(patch, at.X, x, parameters.streaming, body.velocity);
  const Sliding<dim> sliding(relative, n);
  const TractionDerivative<dim> traction(n, body.normal_by_x(seen_x), relative, sliding,
                                         parameters.friction, contact.traction);
  const double rate = parameters.wear.rate(contact.traction, sliding.speed);
  const double rate_by_traction = parameters.wear.rate(1.0, sliding.speed);
  const double rate_by_speed = parameters.wear.rate(contact.traction, 1.0);

  // What depends on the node's own position, as seen from the counter-body.
  const Tensor<dim> force_by_seen =
      surface.area *
      (contact.traction_by_gap * traction.direction * n.transpose() + traction.by_position);
  const Vector<dim> rate_by_seen =
      rate_by_traction * contact.traction_by_gap * n + rate_by_speed * traction.speed_by_position;
  constraint_by_x = contact.constraint_by_gap * n;
  constraint_by_lambda = contact.constraint_by_lambda;
  constraint_by_w = -constraint_by_x.dot(body.approach);
  force_by_lambda = surface.area * contact.traction_by_lambda * traction.direction;
  force_by_w = -force_by_seen * body.approach;
  velocity_by_lambda = -rate_by_traction * contact.traction_by_lambda * surface.normal;
  velocity_by_w = surface.normal * rate_by_seen.dot(body.approach);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p].setZero();
    velocity_by_x[p].setZero();
    force_by_X[p] = contact.traction * traction.direction * derivative.area[p].transpose();
    velocity_by_X[p] = -rate * derivative.normal[p];
  }
  force_by_x[0] = force_by_seen;
  velocity_by_x[0] = -surface.normal * rate_by_seen.transpose();

  if (parameters.streaming.isZero(0)) return;
  const RelativeVelocityDerivative<dim> change(patch, at.X, x, parameters.streaming);
  const Tensor<dim> force_by_v = surface.area * traction.by_velocity;
  const Tensor<dim> velocity_by_v =
      -rate_by_speed * surface.normal * traction.speed_by_velocity.transpose();
  for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
    force_by_x[p] += force_by_v * change.by_x[p];
    force_by_X[p] += force_by_v * change.by_X[p];
    velocity_by_x[p] += velocity_by_v * change.by_x[p];
    velocity_by_X[p] += velocity_by_v * change.by_X[p];
  }
}

template struct ContactNodeTangent<2>;
template struct ContactNodeTangent<3>;

}  // namespace gnomon
