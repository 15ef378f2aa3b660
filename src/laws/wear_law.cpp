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
         std::isfinite(rate.by_friction_power) && std::isfinite(rate.by_mean_friction_power) &&
         std::isfinite(rate.by_contact_share);
}

/// The input at the point about which it is reflected, and its reflection.
struct Reflection {
  WearInput zero, opposite;
};

Reflection of_pressure(const WearInput& at) {
  Reflection of{at, at};
  of.zero.pressure = of.zero.friction_power = 0;
  of.opposite.pressure = -at.pressure;
  of.opposite.friction_power = -at.friction_power;
  return of;
}

Reflection of_mean(const WearInput& at) {
  Reflection of{at, at};
  of.zero.mean_friction_power = 0;
  of.opposite.mean_friction_power = -at.mean_friction_power;
  return of;
}

/// What is no std::exception would pass everything that tells of errors; a plug-in may throw it.
template <class Action>
auto asked(Action&& action) {
  try {
    return action();
  } catch (const std::exception&) {
    throw;
  } catch (...) {
    throw Error("the wear law threw something that is no std::exception");
  }
}

/// Of a depth that is negative by the rounding of positions alone.
bool is_of_rounded_depth(const WearInput& at) {
  constexpr double roundings = 1e-12;
  const auto& x = at.initial;
  const double size = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  return at.depth < 0 && at.depth > -roundings * size;
}

/// A rate that relative changes of 1e-9 of what it depends on make positive: of p v (1 - h / h0) at
/// h0, beyond which iterates come.
bool is_nearly_zero(const WearInput& at, const WearRate& rate) {
  constexpr double change = 1e-9;
  const double size = std::abs(rate.by_pressure * at.pressure) +
                      std::abs(rate.by_speed * at.speed) + std::abs(rate.by_depth * at.depth) +
                      std::abs(rate.by_friction_power * at.friction_power) +
                      std::abs(rate.by_mean_friction_power * at.mean_friction_power);
  return -rate.value <= change * size;
}

/// Whether the smooth part in time ends before, where stages of some methods lie: 950 - t after
/// 950, of max(950 - t, 0).
bool is_continued_in_time(const WearInput& at, const std::vector<double>& breakpoints) {
  const auto end = std::upper_bound(breakpoints.begin(), breakpoints.end(), at.moment.within);
  return end != breakpoints.end() && at.moment.time > *end;
}

/// A law like p^0.8 has no slope at p = 0, where Newton needs one alone: none at all.
void without_slope_at_zero(const WearInput& at, WearRate& rate) {
  if (at.pressure == 0 && !std::isfinite(rate.by_pressure)) rate.by_pressure = 0;
  if (at.friction_power == 0 && !std::isfinite(rate.by_friction_power)) rate.by_friction_power = 0;
  if (at.mean_friction_power == 0 && !std::isfinite(rate.by_mean_friction_power))
    rate.by_mean_friction_power = 0;
}

}  // namespace

WearLaw::WearLaw() {
  static const auto none = std::make_shared<const Definition>(
      Definition{.rate = [](const WearInput&, std::span<const char>) { return WearRate{}; }});
  definition_ = none;
}

WearLaw::WearLaw(Definition definition)
    : definition_(std::make_shared<const Definition>(std::move(definition))) {
  if (!definition_->rate) throw RegistrationError("it is made without `rate`");
  if (kinks() > 0 && !definition_->switching)
    throw RegistrationError("it is made with `kinks`, but without `switching`");
}

WearLaw WearLaw::with_stops(std::vector<double> stops) const {
  Definition definition = *definition_;
  definition.stops = std::move(stops);
  return WearLaw(std::move(definition));
}

/// Derivatives by what is reflected are those at the opposite input.
WearRate WearLaw::continued(const WearInput& at, std::span<const char> branches) const {
  if (at.pressure < 0) {
    const Reflection of = of_pressure(at);
    const WearRate zero = continued(of.zero, branches);
    WearRate rate = continued(of.opposite, branches);
    for (double WearRate::*each : {&WearRate::value, &WearRate::by_speed, &WearRate::by_depth,
                                   &WearRate::by_mean_friction_power})
      rate.*each = 2 * zero.*each - rate.*each;
    return rate;
  }
  if (at.mean_friction_power < 0) {
    const Reflection of = of_mean(at);
    const WearRate zero = continued(of.zero, branches);
    WearRate rate = continued(of.opposite, branches);
    for (double WearRate::*each : {&WearRate::value, &WearRate::by_pressure, &WearRate::by_speed,
                                   &WearRate::by_depth, &WearRate::by_friction_power})
      rate.*each = 2 * zero.*each - rate.*each;
    return rate;
  }
  WearRate rate = asked([&] { return definition_->rate(at, branches); });
  without_slope_at_zero(at, rate);
  return rate;
}

WearRate WearLaw::in_contact(const WearInput& at, std::span<const char> branches) const {
  WearRate rate = continued(at, branches);
  if (!reads_mean() || !(at.contact_share < 1)) return rate;
  const WearRate idle = continued(of_pressure(at).zero, branches);
  if (!(idle.value > 0)) return rate;  // so is a branch beyond its border, of max(q - q_mean, 0)
  for (double WearRate::*each : {&WearRate::value, &WearRate::by_speed, &WearRate::by_depth,
                                 &WearRate::by_mean_friction_power})
    rate.*each -= (1 - at.contact_share) * idle.*each;
  rate.by_contact_share = idle.value;
  return rate;
}

WearRate WearLaw::rate(const WearInput& at, std::span<const char> branches) const {
  const WearRate rate = in_contact(at, branches);
  if (!finite(rate))
    throw RecoverableError(fmt::format(
        "the wear law has no finite rate, or derivatives of it, at p = {:.4g}, v = {:.4g}, h = "
        "{:.4g}, t = {:.4g}",
        at.pressure, at.speed, at.depth, at.moment.time));
  // A branch that is given may be continued to where it is negative.
  if (branches.empty() && at.pressure >= 0 && at.mean_friction_power >= 0 && rate.value < 0 &&
      !is_of_rounded_depth(at) && !is_nearly_zero(at, rate) &&
      !is_continued_in_time(at, breakpoints()))
    throw RecoverableError(fmt::format(
        "the wear law adds material: its rate is {:.4g} at p = {:.4g}, v = {:.4g}, h = {:.4g}, t = "
        "{:.4g}, initial position ({:.4g}, {:.4g}, {:.4g})",
        rate.value, at.pressure, at.speed, at.depth, at.moment.time, at.initial[0], at.initial[1],
        at.initial[2]));
  return rate;
}

void WearLaw::switching(const WearInput& at, std::span<double> values,
                        std::span<const char> branches) const {
  if (kinks() == 0) return;
  const bool pulls = at.pressure < 0;  // not where it is no number, whose reflection is none either
  if (!pulls && !(at.mean_friction_power < 0))
    return asked([&] { definition_->switching(at, branches, values); });
  const Reflection of = pulls ? of_pressure(at) : of_mean(at);
  std::vector<double> zero(values.size());
  switching(of.zero, zero, branches);
  switching(of.opposite, values, branches);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 2 * zero[k] - values[k];
}

}  // namespace gnomon
