// The neo-Hookean law of eq. (38), as a pure function of the deformation gradient.
#pragma once

#include <cmath>
#include <gnomon/base/tensor.hpp>

namespace gnomon {

/// phi(F) = lambda/2 (J - 1)^2 + mu (tr(F^T F) - 3)/2 - mu log J, eq. (38) [stress].
/// In 2D the state is plane strain: F_33 = 1.
struct NeoHookean {
  double lambda = 0;  ///< first Lame parameter [stress]
  double mu = 0;      ///< shear modulus [stress]

  static NeoHookean from_young_poisson(double young, double poisson) {
    const double mu = young / (2 * (1 + poisson));
    return {2 * mu * poisson / (1 - 2 * poisson), mu};
  }
  double young_modulus() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
};

/// The law evaluated at one F with det F > 0.
template <int dim, class Scalar = double>
class NeoHookeanPoint {
public:
  using T = Tensor<dim, Scalar>;

  NeoHookeanPoint(const NeoHookean& law, const T& F)
      : law_(law), F_(F), J_(F.determinant()), F_inverse_transposed_(F.inverse().transpose()) {}

  Scalar energy() const {
    using std::log;
    const Scalar trace_C = F_.squaredNorm() + Scalar(3 - dim);
    return Scalar(law_.lambda / 2) * (J_ - 1) * (J_ - 1) +
           Scalar(law_.mu) * ((trace_C - 3) / Scalar(2) - log(J_));
  }

  /// P = d phi / dF = mu (F - F^-T) + lambda J (J - 1) F^-T.
  T stress() const {
    return Scalar(law_.mu) * (F_ - F_inverse_transposed_) +
           (Scalar(law_.lambda) * J_ * (J_ - 1)) * F_inverse_transposed_;
  }

  /// Cauchy stress component normal to the plane (2D, plane strain): lambda (J - 1).
  Scalar out_of_plane_stress() const { return law_.lambda * (J_ - 1); }

  /// (dP/dF) : dF.
  T stress_change(const T& dF) const {
    const T& G = F_inverse_transposed_;
    return law_.mu * dF + volumetric() * G.cwiseProduct(dF).sum() * G +
           geometric() * G * dF.transpose() * G;
  }

  // [(dP/dF) : (v (x) n_b)] n_a = [shear (n_a . n_b) I + volumetric g_a (x) g_b
  //                                + geometric g_b (x) g_a] v,  g_a = F^-T n_a
  double shear() const { return law_.mu; }
  Scalar volumetric() const { return law_.lambda * J_ * (2 * J_ - 1); }
  Scalar geometric() const { return law_.mu - law_.lambda * J_ * (J_ - 1); }

  const Scalar& J() const { return J_; }

private:
  NeoHookean law_;
  T F_;
  Scalar J_;
  T F_inverse_transposed_;
};

}  // namespace gnomon
