#include <fmt/format.h>

#include <algorithm>
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

std::string described(const WearInput& at) {
  return fmt::format(
      "p = {:.4g}, v = {:.4g}, h = {:.4g}, q = {:.4g}, t = {:.4g}, s = {:.4g} and the initial "
      "position ({:.4g}, {:.4g}, {:.4g})",
      at.pressure, at.speed, at.depth, at.friction_power, at.moment.time, at.moment.slid,
      at.initial[0], at.initial[1], at.initial[2]);
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
    throw RecoverableError("the wear law has no finite rate at " + described(at));
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

void check_wear_law(const WearLaw& law, const WearRange& range, const std::string& where) {
  // Rounding lets a depth be negative where nothing wears.
  constexpr double rounding = 1e-9;
  WearInput at;
  const auto rate = [&] {
    try {
      return law.rate(at);
    } catch (const RecoverableError&) {
      throw InputError(fmt::format("{}: expected a finite wear rate, with finite derivatives, got "
                                   "none at {}",
                                   where, described(at)));
    }
  };
  for (const double time : {0.0, 1e-3, 0.1, 0.5, 1.0})
    for (const double speed : {0.01, 0.1, 1.0, 3.0})
      for (const double depth : {-rounding, 0.0, 0.01, 0.3, 1.0, 2.0})
        for (const auto& initial : range.initial) {
          at.moment = {time * range.duration, time * range.duration * range.nominal_speed,
                       time * range.duration};
          at.speed = speed * range.speed;
          at.depth = depth * range.depth;
          at.initial = initial;
          double largest = 0;
          for (const double pressure : {10.0, 3.0, 1.0, 0.3, 0.01, 1e-4, 0.0}) {
            at.pressure = pressure * range.pressure;
            at.friction_power = range.friction * at.pressure * at.speed;
            const double value = rate().value;
            largest = std::max(largest, value);
            if (pressure == 0 && !(std::abs(value) <= rounding * largest))
              throw InputError(fmt::format(
                  "{}: expected no wear without pressure, got the rate {:.4g} at {}", where, value,
                  described(at)));
            if (value < 0)
              throw InputError(fmt::format("{}: expected a wear rate of zero or more, got {:.4g} "
                                           "at {}",
                                           where, value, described(at)));
          }
        }
}

}  // namespace gnomon
