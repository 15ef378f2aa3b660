// The norm in which a Newton iteration measures its residual.
#pragma once

#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Largest |F_i| / scale_i, scale_i being Structure::row_scale unless allow_for_rounding() raised
/// it.
class ResidualNorm {
public:
  explicit ResidualNorm(const Structure& structure)
      : structure_(structure), scale_(structure.row_scale) {}

  double operator()(std::span<const double> F) const;
  const std::vector<double>& scale() const { return scale_; }

  /// Where rates are rate_weight (y - base), as in short steps, rounding of y leaves more of them
  /// than `acceptable` of their scale: less can be asked of those rows. Their scale becomes what
  /// ten roundings of y leave of them, divided by `acceptable`, where that is more.
  void allow_for_rounding(double rate_weight, std::span<const double> y, double acceptable);

private:
  const Structure& structure_;
  std::vector<double> scale_;
};

}  // namespace gnomon
