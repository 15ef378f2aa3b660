// The size of the error of a step, relative to the tolerances of the scene.
#pragma once

#include <cmath>
#include <gnomon/base/processes.hpp>
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
  ErrorNorm(const Structure& structure, const IntegratorSettings& settings)
      : scale_(structure.tolerance_scale), rtol_(settings.rtol), atol_(settings.atol) {
    for (int i = 0; i < static_cast<int>(structure.size); ++i)
      if (structure.differential[i]) components_.push_back(i);
  }

  /// Positions of the differential components in y.
  const std::vector<int>& components() const { return components_; }
  /// Of component i of y, which has this value.
  double weight(std::size_t i, double y) const {
    const double tolerance = rtol_ * std::abs(y) + (scale_.empty() ? atol_ : atol_ * scale_[i]);
    return tolerance > 0 ? 1 / tolerance : 1;
  }
  /// Norm of an error with one entry per component, at y (the whole vector).
  double operator()(std::span<const double> error, std::span<const double> y) const {
    double sum = 0;
    for (std::size_t k = 0; k < components_.size(); ++k) {
      const double scaled = error[k] * weight(components_[k], y[components_[k]]);
      sum += scaled * scaled;
    }
    return mean(sum);
  }
  /// Norm of the difference of two whole vectors, at y.
  double distance(std::span<const double> a, std::span<const double> b,
                  std::span<const double> y) const {
    double sum = 0;
    for (int i : components_) {
      const double scaled = (a[i] - b[i]) * weight(i, y[i]);
      sum += scaled * scaled;
    }
    return mean(sum);
  }

private:
  /// Root mean square over the components of all processes.
  double mean(double sum_of_squares) const {
    return std::sqrt(sum_over_processes(sum_of_squares) /
                     sum_over_processes(static_cast<double>(components_.size())));
  }

  std::vector<int> components_;
  std::vector<double> scale_;  // Structure::tolerance_scale
  double rtol_, atol_;
};

}  // namespace gnomon
