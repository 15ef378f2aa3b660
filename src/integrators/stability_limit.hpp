// Keeps steps that follow their error within the stability of an explicit method. At its limit the
// error control lets the fastest mode oscillate by the tolerated error, in closed contact as
// pressures that alternate from node to node, and a nonlinear rate does not have the mean that it
// has without: errors within the tolerance add up in every step.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gnomon/integrators/butcher_table.hpp>
#include <limits>

namespace gnomon {

class StabilityLimit {
public:
  /// Of an explicit method.
  explicit StabilityLimit(const ButcherTable& table) {
    constexpr double stride = 0.01;
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(table.stages());
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(table.stages(), table.stages());
    const auto R = [&](double z) {
      return 1 + z * table.b.dot((one - z * table.A).partialPivLu().solve(ones));
    };
    while (std::abs(R(-boundary_ - stride)) <= 1) boundary_ += stride;
  }

  /// The fastest mode that the last step has shown [1/time]. What earlier ones have shown fades,
  /// because modes that are damped are no longer seen.
  void learn(double fastest) { fastest_ = std::max(fastest, kept * fastest_); }
  double longest_step() const {
    return fastest_ > 0 ? safety * boundary_ / fastest_ : std::numeric_limits<double>::infinity();
  }

  double memory() const { return fastest_; }
  void restore(double memory) { fastest_ = memory; }

private:
  static constexpr double safety = 0.8, kept = 0.99;
  double boundary_ = 0;  // along the negative real axis
  double fastest_ = 0;
};

}  // namespace gnomon
