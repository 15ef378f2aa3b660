// How large an error of a step is, by the tolerances of the scene.
#pragma once

#include <cmath>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Weighted root mean square over the differential components (the positions of the contact
/// surface): weights rtol |y_i| + atol. 1 is as large as the tolerance. Fixed steps may go without
/// tolerances; errors are then not scaled.
class ErrorNorm {
public:
  ErrorNorm(const Structure& structure, const IntegratorSettings& settings);

  /// Positions of the differential components in y.
  const std::vector<int>& components() const { return components_; }
  double weight(double y) const {
    const double tolerance = rtol_ * std::abs(y) + atol_;
    return tolerance > 0 ? 1 / tolerance : 1;
  }
  /// Of an error with one entry a component, at y (whole).
  double operator()(std::span<const double> error, std::span<const double> y) const;

private:
  std::vector<int> components_;
  double rtol_, atol_;
};

}  // namespace gnomon
