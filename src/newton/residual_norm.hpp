// The norm in which a Newton iteration measures its residual.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/system/system.hpp>
#include <limits>
#include <span>
#include <vector>

namespace gnomon {

/// Largest |F_i| / scale_i, where scale_i is Structure::row_scale unless allow_for_rounding() has
/// raised it.
class ResidualNorm {
public:
  explicit ResidualNorm(const Structure& structure)
      : structure_(structure), scale_(structure.row_scale) {}

  double operator()(std::span<const double> F) const {
    double largest = 0;
    for (std::size_t i = 0; i < F.size(); ++i)
      largest = std::max(largest, std::abs(F[i]) / scale_[i]);
    return largest_over_processes(largest);
  }

  const std::vector<double>& scale() const { return scale_; }

  /// Where rates are rate_weight (y - base), in short steps rounding of y may change them by more
  /// than `acceptable` times their scale, so that those rows cannot be solved to this accuracy.
  /// Their scale is raised to the effect of ten rounding errors of y, divided by `acceptable`, if
  /// that is larger.
  void allow_for_rounding(double rate_weight, std::span<const double> y, double acceptable) {
    constexpr double roundings = 10 * std::numeric_limits<double>::epsilon();
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!structure_.differential[i]) continue;
      const double rounding = roundings * rate_weight * std::abs(y[i]);
      scale_[i] = std::max(structure_.row_scale[i], rounding / acceptable);
    }
  }

private:
  const Structure& structure_;
  std::vector<double> scale_;
};

}  // namespace gnomon
