// Linear elasticity, the small-strain limit of every elastic law, as a pure function of the
// displacement gradient.
#pragma once

#include <gnomon/laws/elastic_law.hpp>

namespace gnomon {

/// sigma = lambda tr(eps) I + 2 mu eps, eps = sym H, H the displacement gradient. In 2D the state
/// is plane strain.
template <int dim, class Scalar = double>
class LinearElasticPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::small;

  LinearElasticPoint(const ElasticModuli& moduli, const T& H)
      : lambda_(moduli.lambda), mu_(moduli.mu), H_(H) {}

  /// sigma : eps / 2 [stress].
  Scalar energy() const { return stress().cwiseProduct(H_).sum() / Scalar(2); }

  T stress() const { return stress_change(H_); }

  T stress_change(const T& dH) const {
    return Scalar(lambda_) * dH.trace() * T::Identity() + Scalar(mu_) * (dH + dH.transpose());
  }

  // Of DyadicPoint: [dsigma : (v (x) n_b)] n_a = [shear (n_a . n_b) I + volumetric n_a (x) n_b
  //                                              + geometric n_b (x) n_a] v
  double shear() const { return mu_; }
  double volumetric() const { return lambda_; }
  double geometric() const { return mu_; }

private:
  double lambda_, mu_;
  T H_;
};

}  // namespace gnomon
