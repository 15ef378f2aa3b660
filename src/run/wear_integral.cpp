#include "run/wear_integral.hpp"

#include <cmath>

namespace gnomon {

namespace {

std::string integrated_unit(const std::string& unit) {
  const std::string per_second = "/s";
  if (unit.ends_with(per_second)) return unit.substr(0, unit.size() - per_second.size());
  return unit.empty() ? "s" : unit + " s";
}

}  // namespace

void WearIntegral::append_to(std::vector<Scalar>& scalars, double t) {
  const Scalar* flux = find_scalar(scalars, "wear_flux");
  if (!flux) return;
  if (started_) value_ += (t - t_) * (flux_ + flux->value) / 2;
  started_ = true;
  t_ = t;
  flux_ = flux->value;
  const std::string unit = integrated_unit(flux->unit);
  scalars.push_back({"wear_integral", unit, value_});
}

void WearIntegral::resume(const std::vector<Scalar>& scalars, double t) {
  t_ = t;
  if (const Scalar* flux = find_scalar(scalars, "wear_flux")) flux_ = flux->value;
  const Scalar* integral = find_scalar(scalars, "wear_integral");
  if (!integral) return;
  value_ = integral->value;
  started_ = true;
}

bool has_lost_wear(const std::vector<Scalar>& scalars) {
  constexpr double most = 0.1;  // of the integral; the coarsest meshes lose some hundredths
  const Scalar* worn = find_scalar(scalars, "worn_volume");
  const Scalar* integral = find_scalar(scalars, "wear_integral");
  if (!worn || !integral || worn->value == 0) return false;
  return !(std::abs(worn->value - integral->value) <= most * std::abs(integral->value));
}

}  // namespace gnomon
