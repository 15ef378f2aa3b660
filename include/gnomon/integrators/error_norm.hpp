// The size of the error of a step, relative to the tolerances of the scene.
#pragma once

#include <cmath>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Weighted root mean square over the differential components (the positions of the contact
/// surface): weights rtol |y_i| + atol, times the tolerance scale of the block. The value 1 means
/// an error equal to the tolerance. With fixed steps there may be no tolerances; errors are then
/// not scaled.
class ErrorNorm {
public:
  ErrorNorm(const Structure& structure, const IntegratorSettings& settings);

  /// Positions of the differential components in y.
  const std::vector<int>& components() const { return components_; }
  /// Of component i of y, which has this value.
  double weight(std::size_t i, double y) const {
    const double tolerance = rtol_ * std::abs(y) + (scale_.empty() ? atol_ : atol_ * scale_[i]);
    return tolerance > 0 ? 1 / tolerance : 1;
  }
  /// Norm of an error with one entry per component, at y (the whole vector).
  double operator()(std::span<const double> error, std::span<const double> y) const;
  /// Norm of the difference of two whole vectors, at y.
  double distance(std::span<const double> a, std::span<const double> b,
                  std::span<const double> y) const;

private:
  double mean(double sum_of_squares) const;

  std::vector<int> components_;
  std::vector<double> scale_;  // Structure::tolerance_scale
  double rtol_, atol_;
};

}  // namespace gnomon
