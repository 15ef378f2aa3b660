#include "run/wear_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {

WearIntegral::WearIntegral(const Model& model) {
  if (model.wear_flux) value_ = 0;
}

void WearIntegral::resume(const Observation& last) {
  if (value_) value_ = value_of(last, "wear_integral").value_or(0);
}

void WearIntegral::add(double increment) {
  if (value_) *value_ += increment;
}

double invisible_volume(const std::optional<Grid>& grid, int dim) {
  if (!grid || grid->points.empty()) return 0;
  constexpr double sums = 100;  // many cells add their rounding errors
  std::array<double, 3> low = grid->points.front(), high = low;
  for (const auto& point : grid->points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  const bool flat = grid->cell == Grid::Cell::quadrilateral;
  double volume = (high[0] - low[0]) * (high[1] - low[1]) * (flat ? 1 : high[2] - low[2]);
  if (flat && dim == 3) volume *= 2 * M_PI * high[0];
  return sums * std::numeric_limits<double>::epsilon() * volume;
}

bool has_lost_wear(const Observation& observed, double invisible) {
  constexpr double most =
      0.1;  // part of the integral; on the coarsest meshes a few hundredths differ
  const std::optional<double> difference = wear_difference(observed);
  if (!difference) return false;
  const double integral = *value_of(observed, "wear_integral");
  return !(std::abs(*difference) <= most * std::abs(integral) + invisible);
}

}  // namespace gnomon
