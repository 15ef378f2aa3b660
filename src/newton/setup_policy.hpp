// Decides when a preconditioner that is kept for changing Jacobians is made again.
#pragma once

#include <algorithm>

namespace gnomon {

/// A set-up is due when the additional cost of the old preconditioner (Krylov iterations beyond
/// those of a fresh one, and updates) has reached the cost of a set-up. Counts decide, not measured
/// times, so that runs are reproducible.
class SetupPolicy {
public:
  bool due() const { return failed_ || spent_ >= cost_; }
  /// Whether the mesh motion must be set up too, because a fresh stiffness alone no longer reduces
  /// the iterations.
  bool whole() const { return failed_ || fresh_rate_ > 1.5 * whole_rate_; }

  /// Called after a set-up. `cost`: in applications of the preconditioner.
  void made(bool whole, double cost) {
    cost_ = cost;
    if (whole) whole_rate_ = 0;
    fresh_ = true;
    failed_ = false;
    fresh_rate_ = spent_ = 0;
  }
  /// Called after a solve that reduced the residual by `digits` powers of ten.
  void solved(int iterations, double digits) {
    const double rate = iterations / std::max(digits, 0.1);
    if (fresh_) {
      fresh_rate_ = rate;
      if (whole_rate_ == 0) whole_rate_ = rate;
    }
    spent_ += applications_an_iteration * std::max(0.0, iterations - fresh_rate_ * digits);
    fresh_ = false;
  }
  /// Called before an update that costs that many applications; the update is not made if a set-up
  /// is due then.
  void spent(double applications) { spent_ += applications; }
  /// Called after a solve that did not converge.
  void failed() { failed_ = true; }
  /// Whether there was no solve since the set-up.
  bool fresh() const { return fresh_; }

private:
  static constexpr double applications_an_iteration = 2;  // product with J and orthogonalisation
  double cost_ = 0, whole_rate_ = 0;
  bool fresh_ = false, failed_ = true;
  double fresh_rate_ = 0, spent_ = 0;
};

}  // namespace gnomon
