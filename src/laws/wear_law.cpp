#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/wear_law.hpp>

namespace gnomon {

namespace {

bool finite(const WearRate& rate) {
  return std::isfinite(rate.value) && std::isfinite(rate.by_pressure) &&
         std::isfinite(rate.by_speed) && std::isfinite(rate.by_depth) &&
         std::isfinite(rate.by_friction_power);
}

WearInput with_pressure(const WearInput& at, double pressure, double friction_power) {
  WearInput result = at;
  result.pressure = pressure;
  result.friction_power = friction_power;
  return result;
}

/// A law like p^0.8 has no slope at p = 0, where Newton needs one alone: none at all.
void without_slope_at_zero(const WearInput& at, WearRate& rate) {
  if (at.pressure == 0 && !std::isfinite(rate.by_pressure)) rate.by_pressure = 0;
  if (at.friction_power == 0 && !std::isfinite(rate.by_friction_power)) rate.by_friction_power = 0;
}

}  // namespace

WearLaw::WearLaw() {
  static const auto none = std::make_shared<const Definition>(
      Definition{.rate = [](const WearInput&, std::span<const char>) { return WearRate{}; }});
  definition_ = none;
}

WearLaw::WearLaw(Definition definition)
    : definition_(std::make_shared<const Definition>(std::move(definition))) {}

WearRate WearLaw::rate(const WearInput& at, std::span<const char> branches) const {
  WearRate rate;
  if (at.pressure >= 0) {
    rate = definition_->rate(at, branches);
    without_slope_at_zero(at, rate);
  } else {
    const WearRate zero = definition_->rate(with_pressure(at, 0, 0), branches);
    rate = definition_->rate(with_pressure(at, -at.pressure, -at.friction_power), branches);
    rate.value = 2 * zero.value - rate.value;
    rate.by_speed = 2 * zero.by_speed - rate.by_speed;
    rate.by_depth = 2 * zero.by_depth - rate.by_depth;
  }
  if (!finite(rate))
    throw RecoverableError(fmt::format(
        "the wear law has no finite rate at p = {:.4g}, v = {:.4g}, h = {:.4g}, t = {:.4g}",
        at.pressure, at.speed, at.depth, at.moment.time));
  return rate;
}

void WearLaw::switching(const WearInput& at, std::span<double> values,
                        std::span<const char> branches) const {
  if (kinks() == 0) return;
  if (at.pressure >= 0) return definition_->switching(at, branches, values);
  std::vector<double> zero(values.size());
  definition_->switching(with_pressure(at, 0, 0), branches, zero);
  definition_->switching(with_pressure(at, -at.pressure, -at.friction_power), branches, values);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 2 * zero[k] - values[k];
}

}  // namespace gnomon
