#include "newton/residual_norm.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <limits>

namespace gnomon {

double ResidualNorm::operator()(std::span<const double> F) const {
  double largest = 0;
  for (std::size_t i = 0; i < F.size(); ++i)
    largest = std::max(largest, std::abs(F[i]) / scale_[i]);
  return largest_over_processes(largest);
}

void ResidualNorm::allow_for_rounding(double rate_weight, std::span<const double> y,
                                      double acceptable) {
  constexpr double roundings = 10 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!structure_.differential[i]) continue;
    const double rounding = roundings * rate_weight * std::abs(y[i]);
    scale_[i] = std::max(structure_.row_scale[i], rounding / acceptable);
  }
}

}  // namespace gnomon
