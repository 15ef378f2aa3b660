// When a preconditioner that is kept over changing Jacobians is made anew.
#pragma once

#include <algorithm>

namespace gnomon {

/// A set-up is due when what was spent on doing without amounts to its price: on Krylov iterations
/// beyond those of a fresh preconditioner, on updates. Counts decide, never clocks, so that runs
/// repeat.
class SetupPolicy {
public:
  bool due() const { return failed_ || spent_ >= cost_; }
  /// Whether the mesh motion is to be set up with the rest, for a fresh stiffness alone no longer
  /// brings the iterations down.
  bool whole() const { return failed_ || fresh_rate_ > 1.5 * whole_rate_; }

  /// After a set-up. `cost`: what it cost, in applications of the preconditioner.
  void made(bool whole, double cost) {
    cost_ = cost;
    if (whole) whole_rate_ = 0;
    fresh_ = true;
    failed_ = false;
    fresh_rate_ = spent_ = 0;
  }
  /// After a solve that reduced the residual by `digits` powers of ten.
  void solved(int iterations, double digits) {
    const double rate = iterations / std::max(digits, 0.1);
    if (fresh_) {
      fresh_rate_ = rate;
      if (whole_rate_ == 0) whole_rate_ = rate;
    }
    spent_ += applications_an_iteration * std::max(0.0, iterations - fresh_rate_ * digits);
    fresh_ = false;
  }
  /// Before an update that costs that many applications; it is not made if a set-up is due then.
  void spent(double applications) { spent_ += applications; }
  /// After a solve that did not converge.
  void failed() { failed_ = true; }
  /// Whether nothing was solved since the set-up.
  bool fresh() const { return fresh_; }

private:
  static constexpr double applications_an_iteration = 2;  // product with J and orthogonalisation
  double cost_ = 0, whole_rate_ = 0;
  bool fresh_ = false, failed_ = true;
  double fresh_rate_ = 0, spent_ = 0;
};

}  // namespace gnomon
