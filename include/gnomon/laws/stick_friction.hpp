// Coulomb friction with stick of one node: eq. (10), (11), by an augmented Lagrangian.
#pragma once

#include <cmath>
#include <gnomon/base/lift.hpp>
#include <gnomon/base/tensor.hpp>
#include <optional>

namespace gnomon {

/// The traction with which a node resists the slip in the tangential plane, in one phase of a path:
///
///   T^ = P (lambda_T + rho slip),  r = -f lambda_eff,  P = 1 - n n'
///
///   open     T = 0,           C = -lambda_T / rho
///   stick    |T^| <= r:       T = T^,            C = P slip - n n' lambda_T / rho
///   slip     T = r T^ / |T^|, C = (T - lambda_T) / rho
///
/// lambda_T is the multiplier [stress], `slip` that of the body on its partner in the phase
/// [length], `limit` r [stress], rho > 0 the regularization [stress / length].
template <int dim, class Scalar = double>
struct StickFriction {
  bool sticks = false;
  Vector<dim, Scalar> traction = Vector<dim, Scalar>::Zero();  ///< T, along the slip [stress]
  Vector<dim, Scalar> constraint;                              ///< C [length]
  /// |T^| - r, negative or zero where the node sticks [stress].
  double excess;

  /// `closed`: whether the node is in contact; `given`: whether it sticks, where that is not chosen
  /// by the size of T^.
  StickFriction(const Vector<dim, Scalar>& lambda, const Vector<dim, Scalar>& slip,
                const Vector<dim, Scalar>& normal, const Scalar& limit, double rho, bool closed,
                std::optional<bool> given = {}) {
    using std::sqrt;
    const auto along = [&normal](const Vector<dim, Scalar>& v) -> Vector<dim, Scalar> {
      return v - normal * normal.dot(v);
    };
    const Vector<dim, Scalar> trial = along(lambda + Scalar(rho) * slip);
    const Scalar square = trial.squaredNorm();
    excess = std::sqrt(plain(square)) - plain(limit);
    constraint = -lambda / Scalar(rho);
    if (!closed) return;
    sticks = given.value_or(excess <= 0);
    if (sticks) {
      traction = trial;
      constraint += trial / Scalar(rho);
    } else if (square > Scalar(0)) {
      traction = trial * Scalar(limit / sqrt(square));
      constraint += traction / Scalar(rho);
    }
  }
};

}  // namespace gnomon
