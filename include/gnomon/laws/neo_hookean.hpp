// The neo-Hookean law of eq. (38), as a pure function of the deformation gradient.
#pragma once

#include <cmath>
#include <gnomon/laws/elastic_law.hpp>

namespace gnomon {

/// phi(F) = lambda/2 (J - 1)^2 + mu (tr(F^T F) - 3)/2 - mu log J, eq. (38) [stress].
/// In 2D the state is plane strain: F_33 = 1.
template <int dim, class Scalar = double>
class NeoHookeanPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::finite;

  NeoHookeanPoint(const ElasticModuli& moduli, const T& F)
      : lambda_(moduli.lambda),
        mu_(moduli.mu),
        F_(F),
        J_(F.determinant()),
        F_inverse_transposed_(F.inverse().transpose()) {}

  Scalar energy() const {
    using std::log;
    const Scalar trace_C = F_.squaredNorm() + Scalar(3 - dim);
    return Scalar(lambda_ / 2) * (J_ - 1) * (J_ - 1) +
           Scalar(mu_) * ((trace_C - 3) / Scalar(2) - log(J_));
  }

  /// P = d phi / dF = mu (F - F^-T) + lambda J (J - 1) F^-T.
  T stress() const {
    return Scalar(mu_) * (F_ - F_inverse_transposed_) +
           (Scalar(lambda_) * J_ * (J_ - 1)) * F_inverse_transposed_;
  }

  /// (dP/dF) : dF.
  T stress_change(const T& dF) const {
    const T& G = F_inverse_transposed_;
    return mu_ * dF + volumetric() * G.cwiseProduct(dF).sum() * G +
           geometric() * G * dF.transpose() * G;
  }

  // Of DyadicPoint: [(dP/dF) : (v (x) n_b)] n_a = [shear (n_a . n_b) I + volumetric g_a (x) g_b
  //                                                + geometric g_b (x) g_a] v,  g_a = F^-T n_a
  double shear() const { return mu_; }
  Scalar volumetric() const { return lambda_ * J_ * (2 * J_ - 1); }
  Scalar geometric() const { return mu_ - lambda_ * J_ * (J_ - 1); }

private:
  double lambda_, mu_;
  T F_;
  Scalar J_;
  T F_inverse_transposed_;
};

}  // namespace gnomon
