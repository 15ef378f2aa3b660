#include "run/wear_integral.hpp"

#include <cmath>

namespace gnomon {

WearIntegral::WearIntegral(const Model& model) {
  if (model.wear_flux()) value_ = 0;
}

void WearIntegral::resume(const Observation& last) {
  if (value_) value_ = last.wear_integral.value_or(0);
}

void WearIntegral::add(double increment) {
  if (value_) *value_ += increment;
}

bool has_lost_wear(const Observation& observed) {
  constexpr double most =
      0.1;  // part of the integral; on the coarsest meshes a few hundredths differ
  const std::optional<double> difference = observed.wear_difference();
  if (!difference || *observed.worn_volume == 0) return false;
  return !(std::abs(*difference) <= most * std::abs(*observed.wear_integral));
}

}  // namespace gnomon
