#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/error_norm.hpp>

namespace gnomon {

ErrorNorm::ErrorNorm(const Structure& structure, const IntegratorSettings& settings)
    : rtol_(settings.rtol), atol_(settings.atol) {
  for (int i = 0; i < static_cast<int>(structure.size); ++i)
    if (structure.differential[i]) components_.push_back(i);
}

double ErrorNorm::operator()(std::span<const double> error, std::span<const double> y) const {
  double sum = 0;
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const double scaled = error[k] * weight(y[components_[k]]);
    sum += scaled * scaled;
  }
  return std::sqrt(sum_over_processes(sum) /
                   sum_over_processes(static_cast<double>(components_.size())));
}

}  // namespace gnomon
