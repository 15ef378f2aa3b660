// The Blatz-Ko law, which resists the loss of volume far more than eq. (38) does; same interface as
// NeoHookeanPoint. For the mesh motion, whose elastic energy is free to choose (sec. 2.5).
#pragma once

#include <gnomon/laws/neo_hookean.hpp>

namespace gnomon {

/// phi(F) = mu/2 (tr(F^T F) - 3) + (mu/b) (J^-b - 1), b = lambda/mu = 2 nu/(1 - 2 nu) [stress]; for
/// b = 0 the last term is -mu log J. lambda and mu are those of its linearisation. In 2D the state
/// is plane strain.
template <int dim, class Scalar = double>
class BlatzKoPoint {
public:
  using T = Tensor<dim, Scalar>;

  BlatzKoPoint(const NeoHookean& law, const T& F)
      : law_(law),
        F_(F),
        barrier_(barrier(law, F)),
        F_inverse_transposed_(F.inverse().transpose()) {}

  /// lambda > 0.
  Scalar energy() const {
    const Scalar trace_C = F_.squaredNorm() + Scalar(3 - dim);
    return Scalar(law_.mu / 2) * (trace_C - 3) +
           Scalar(law_.mu * law_.mu / law_.lambda) * (barrier_ - 1);
  }

  /// P = mu (F - J^-b F^-T).
  T stress() const { return Scalar(law_.mu) * (F_ - barrier_ * F_inverse_transposed_); }

  // As of NeoHookeanPoint.
  double shear() const { return law_.mu; }
  Scalar volumetric() const { return law_.lambda * barrier_; }
  Scalar geometric() const { return law_.mu * barrier_; }

private:
  static Scalar barrier(const NeoHookean& law, const T& F) {
    using std::pow;
    return pow(Scalar(F.determinant()), -law.lambda / law.mu);
  }

  NeoHookean law_;
  T F_;
  Scalar barrier_;  ///< J^-b
  T F_inverse_transposed_;
};

}  // namespace gnomon
