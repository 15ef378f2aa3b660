#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/error_norm.hpp>

namespace gnomon {

ErrorNorm::ErrorNorm(const Structure& structure, const IntegratorSettings& settings)
    : scale_(structure.tolerance_scale), rtol_(settings.rtol), atol_(settings.atol) {
  for (int i = 0; i < static_cast<int>(structure.size); ++i)
    if (structure.differential[i]) components_.push_back(i);
}

/// Root mean square over the components of all processes.
double ErrorNorm::mean(double sum_of_squares) const {
  return std::sqrt(sum_over_processes(sum_of_squares) /
                   sum_over_processes(static_cast<double>(components_.size())));
}

double ErrorNorm::operator()(std::span<const double> error, std::span<const double> y) const {
  double sum = 0;
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const double scaled = error[k] * weight(components_[k], y[components_[k]]);
    sum += scaled * scaled;
  }
  return mean(sum);
}

double ErrorNorm::distance(std::span<const double> a, std::span<const double> b,
                           std::span<const double> y) const {
  double sum = 0;
  for (int i : components_) {
    const double scaled = (a[i] - b[i]) * weight(i, y[i]);
    sum += scaled * scaled;
  }
  return mean(sum);
}

}  // namespace gnomon
