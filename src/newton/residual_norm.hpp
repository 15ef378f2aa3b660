// What a Newton iteration measures of an iterate: the norm of its residual, and how much of the
// typical load acts.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/fields/block.hpp>
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

/// The largest contact multiplier in units of its typical value, at least `least` and at most 1.
/// Under a thousandth of the load forces have to balance to a thousandth of what is enough
/// otherwise. 1 for systems without contact.
class PressureLevel {
public:
  explicit PressureLevel(const Structure& structure) : scale_(structure.unknown_scale) {
    for (std::size_t i = 0; i < structure.block.size(); ++i)
      if (structure.block_of(i).role == Role::multiplier)
        multipliers_.push_back(static_cast<int>(i));
  }

  double operator()(std::span<const double> y) const {
    constexpr double least = 1e-6;
    double level = multipliers_.empty() ? 1 : least;
    for (int i : multipliers_) level = std::max(level, std::abs(y[i]) / scale_[i]);
    return std::min(1.0, largest_over_processes(level));
  }

private:
  std::vector<int> multipliers_;
  const std::vector<double>& scale_;
};

}  // namespace gnomon
