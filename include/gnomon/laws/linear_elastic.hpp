// Linear elasticity, the small-strain limit of the neo-Hookean law, as a pure function of the
// displacement gradient; same interface as NeoHookeanPoint.
#pragma once

#include <gnomon/laws/neo_hookean.hpp>

namespace gnomon {

/// sigma = lambda tr(eps) I + 2 mu eps, eps = sym H, H the displacement gradient. In 2D the state
/// is plane strain.
template <int dim, class Scalar = double>
class LinearElasticPoint {
public:
  using T = Tensor<dim, Scalar>;

  LinearElasticPoint(const NeoHookean& law, const T& H) : law_(law), H_(H) {}

  T stress() const { return stress_change(H_); }

  /// Stress component normal to the plane (2D, plane strain).
  Scalar out_of_plane_stress() const { return Scalar(law_.lambda) * H_.trace(); }

  T stress_change(const T& dH) const {
    return Scalar(law_.lambda) * dH.trace() * T::Identity() +
           Scalar(law_.mu) * (dH + dH.transpose());
  }

  // [dsigma : (v (x) n_b)] n_a = [shear (n_a . n_b) I + volumetric n_a (x) n_b
  //                               + geometric n_b (x) n_a] v
  double shear() const { return law_.mu; }
  double volumetric() const { return law_.lambda; }
  double geometric() const { return law_.mu; }

private:
  NeoHookean law_;
  T H_;
};

}  // namespace gnomon
