// The compressible law of Mooney and Rivlin, in the form of P. G. Ciarlet and G. Geymonat, C. R.
// Acad. Sci. Paris II 295 (1982) 423; G. A. Holzapfel, Nonlinear Solid Mechanics (2000), eq.
// (6.147). Its tangent is a general one: the second invariant does not give dyads.
#pragma once

#include <cmath>
#include <gnomon/laws/elastic_law.hpp>

namespace gnomon {

/// phi(F) = C10 (I1 - 3) + C01 (I2 - 3) - 2 (C10 + 2 C01) log J + c (J - 1)^2 [stress], I1 and I2
/// the invariants of C = F^T F, with
///   C01 = s mu/2,   C10 = (1 - s) mu/2,   c = lambda/2 - s mu,   s = C01/(C10 + C01) = ratios[0],
/// so that lambda and mu are those of its linearization; s = 0 is eq. (38). The energy is
/// polyconvex for 0 <= s <= min(1, lambda/(2 mu)). In 2D the state is plane strain.
template <int dim, class Scalar = double>
class MooneyRivlinPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::finite;

  MooneyRivlinPoint(const ElasticModuli& moduli, const T& F)
      : C10_((1 - moduli.ratios[0]) * moduli.mu / 2),
        C01_(moduli.ratios[0] * moduli.mu / 2),
        c_(moduli.lambda / 2 - 2 * C01_),
        F_(F),
        C_(F.transpose() * F),
        I1_(C_.trace() + Scalar(3 - dim)),
        J_(F.determinant()),
        F_inverse_transposed_(F.inverse().transpose()) {}

  Scalar energy() const {
    using std::log;
    const Scalar square = C_.squaredNorm() + Scalar(3 - dim);  // tr C^2
    const Scalar I2 = (I1_ * I1_ - square) / Scalar(2);
    return Scalar(C10_) * (I1_ - 3) + Scalar(C01_) * (I2 - 3) - Scalar(barrier()) * log(J_) +
           Scalar(c_) * (J_ - 1) * (J_ - 1);
  }

  /// P = 2 C10 F + 2 C01 (I1 F - F C) + [2 c J (J - 1) - 2 (C10 + 2 C01)] F^-T.
  T stress() const {
    return Scalar(2 * C10_) * F_ + Scalar(2 * C01_) * (I1_ * F_ - F_ * C_) +
           (Scalar(2 * c_) * J_ * (J_ - 1) - Scalar(barrier())) * F_inverse_transposed_;
  }

  /// (dP/dF) : dF.
  T stress_change(const T& dF) const {
    const T& G = F_inverse_transposed_;
    const T dC = dF.transpose() * F_ + F_.transpose() * dF;
    return Scalar(2 * C10_) * dF +
           Scalar(2 * C01_) * (dC.trace() * F_ + I1_ * dF - dF * C_ - F_ * dC) +
           (Scalar(2 * c_) * J_ * (2 * J_ - 1) * G.cwiseProduct(dF).sum()) * G +
           (Scalar(barrier()) - Scalar(2 * c_) * J_ * (J_ - 1)) * G * dF.transpose() * G;
  }

private:
  double barrier() const { return 2 * (C10_ + 2 * C01_); }  // factor of the term that resists J = 0

  double C10_, C01_, c_;
  T F_, C_;
  Scalar I1_, J_;
  T F_inverse_transposed_;
};

}  // namespace gnomon
