// The law of P. J. Blatz and W. L. Ko, Trans. Soc. Rheol. 6 (1962) 223, which resists the loss of
// volume far more than eq. (38) does. For the mesh motion, whose elastic energy is free to choose
// (sec. 2.5), and for foams.
#pragma once

#include <cmath>
#include <gnomon/laws/elastic_law.hpp>

namespace gnomon {

/// phi(F) = mu/2 (tr(F^T F) - 3) + (mu/b) (J^-b - 1), b = lambda/mu = 2 nu/(1 - 2 nu) [stress]; for
/// b = 0 the last term is -mu log J. lambda and mu are those of its linearization. In 2D the state
/// is plane strain.
template <int dim, class Scalar = double>
class BlatzKoPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::finite;

  BlatzKoPoint(const ElasticModuli& moduli, const T& F)
      : lambda_(moduli.lambda),
        mu_(moduli.mu),
        F_(F),
        barrier_(barrier(moduli, F)),
        F_inverse_transposed_(F.inverse().transpose()) {}

  /// lambda > 0.
  Scalar energy() const {
    const Scalar trace_C = F_.squaredNorm() + Scalar(3 - dim);
    return Scalar(mu_ / 2) * (trace_C - 3) + Scalar(mu_ * mu_ / lambda_) * (barrier_ - 1);
  }

  /// P = mu (F - J^-b F^-T).
  T stress() const { return Scalar(mu_) * (F_ - barrier_ * F_inverse_transposed_); }

  /// (dP/dF) : dF.
  T stress_change(const T& dF) const {
    const T& G = F_inverse_transposed_;
    return mu_ * dF + volumetric() * G.cwiseProduct(dF).sum() * G +
           geometric() * G * dF.transpose() * G;
  }

  // Of DyadicPoint.
  double shear() const { return mu_; }
  Scalar volumetric() const { return lambda_ * barrier_; }
  Scalar geometric() const { return mu_ * barrier_; }

private:
  static Scalar barrier(const ElasticModuli& moduli, const T& F) {
    using std::pow;
    return pow(Scalar(F.determinant()), -moduli.lambda / moduli.mu);
  }

  double lambda_, mu_;
  T F_;
  Scalar barrier_;  ///< J^-b
  T F_inverse_transposed_;
};

}  // namespace gnomon
