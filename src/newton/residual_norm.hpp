// The norm in which a Newton iteration measures its residual.
#pragma once

#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Largest |F_i| / scale_i, where scale_i is Structure::row_scale unless allow_for_rounding() has
/// raised it.
class ResidualNorm {
public:
  explicit ResidualNorm(const Structure& structure)
      : structure_(structure), scale_(structure.row_scale) {}

  double operator()(std::span<const double> F) const;
  const std::vector<double>& scale() const { return scale_; }

  /// Where rates are rate_weight (y - base), in short steps rounding of y may change them by more
  /// than `acceptable` times their scale, so that those rows cannot be solved to this accuracy.
  /// Their scale is raised to the effect of ten rounding errors of y, divided by `acceptable`, if
  /// that is larger.
  void allow_for_rounding(double rate_weight, std::span<const double> y, double acceptable);

private:
  const Structure& structure_;
  std::vector<double> scale_;
};

}  // namespace gnomon
