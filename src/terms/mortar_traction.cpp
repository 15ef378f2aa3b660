#include <gnomon/laws/stick_friction.hpp>
#include <gnomon/terms/mortar_traction.hpp>

#include "terms/independent_variables.hpp"

namespace gnomon {

template <int dim>
MortarTraction<dim>::MortarTraction(const SlidingTraction<dim>& sliding, double lambda)
    : MortarTraction(1) {
  value = lambda * sliding.direction;
  by_own = sliding.direction;
  by_n = lambda * sliding.direction_by.template leftCols<dim>();
  by_x = lambda * sliding.direction_by.template rightCols<dim>();
  pressure = -lambda;
  pressure_by_own[0] = -1;
  speed = sliding.speed;
  speed_by_n = sliding.speed_by.template head<dim>();
  speed_by_x = sliding.speed_by.template tail<dim>();
}

namespace {

/// Own unknowns, the normal, and the depth.
template <int dim>
inline constexpr int variables = StickingTraction<dim>::own + dim + 1;
template <int dim>
using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, variables<dim>, 1>>;

}  // namespace

template <int dim>
StickingTraction<dim>::StickingTraction(const StickingParameters& parameters,
                                        const StickingInput<dim>& at, bool closed,
                                        std::optional<bool> given) {
  using Scalar = Number<dim>;
  using std::sqrt;
  IndependentVariables<Scalar> independent(variables<dim>);
  const Scalar lambda = independent(at.lambda);
  const Vector<dim, Scalar> own_traction = independent(at.traction), place = independent(at.place);
  const Scalar lambda_before = independent(at.lambda_before);
  const Vector<dim, Scalar> before = independent(at.before), n = independent(at.normal);
  const Scalar depth = independent(0.0), coefficient = Scalar(parameters.friction) +
                                                       Scalar(parameters.friction_by_depth) * depth;

  const Vector<dim, Scalar> lambda_T = at.turn[0].template cast<Scalar>() * own_traction,
                            moved = at.turn[1].template cast<Scalar>() * (place - before),
                            kept = moved - at.dropped.template cast<Scalar>() *
                                               at.dropped.template cast<Scalar>().dot(moved),
                            along = parameters.rubs
                                        ? Vector<dim, Scalar>(kept - n * n.dot(kept))
                                        : Vector<dim, Scalar>(Vector<dim, Scalar>::Zero());
  const StickFriction<dim, Scalar> friction(
      lambda_T, along, n, closed ? Scalar(-coefficient * lambda) : Scalar(0), parameters.rho,
      closed && parameters.rubs && parameters.friction > 0, given);
  const Vector<dim, Scalar> back =
      at.turn[0].transpose().template cast<Scalar>() * friction.constraint;
  const Scalar square = along.squaredNorm();
  Scalar speed(0), pressure(0);
  if (!friction.sticks && square > Scalar(0)) speed = sqrt(square) / Scalar(parameters.interval);
  if (closed && at.lambda < 0) pressure -= Scalar(0.5) * lambda;
  if (lambda_before < Scalar(0)) pressure -= Scalar(0.5) * lambda_before;

  this->friction = parameters.friction;
  sticks = friction.sticks;
  excess = friction.excess;
  slip = at.turn[0].transpose() * plain(along);
  constraint = plain(back);
  for (int i = 0; i < dim; ++i) {
    const auto by = back[i].derivatives().transpose();
    constraint_by_own.row(i) = by.template head<own>();
    constraint_by_n.row(i) = by.template segment<dim>(own);
    constraint_by_depth[i] = by[own + dim];
  }
  traction.pressure = plain(pressure);
  traction.pressure_by_own = pressure.derivatives().template head<own>().transpose();
  traction.speed = plain(speed);
  traction.speed_by_own = speed.derivatives().template head<own>().transpose();
  traction.speed_by_n = speed.derivatives().template segment<dim>(own).transpose();
  if (!closed) return;
  traction.value = -at.lambda * at.normal + at.turn[0] * at.traction;
  traction.by_own.col(0) = -at.normal;
  traction.by_own.template middleCols<dim>(1) = at.turn[0];
  traction.by_n = -at.lambda * Tensor<dim>::Identity();
}

template struct MortarTraction<2>;
template struct MortarTraction<3>;
template struct StickingTraction<2>;
template struct StickingTraction<3>;

}  // namespace gnomon
