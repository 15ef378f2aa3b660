#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <utility>

namespace gnomon {

namespace {

std::string described(const WearInput& at, bool with_mean) {
  return fmt::format(
      "p = {:.4g}, v = {:.4g}, h = {:.4g}, q = {:.4g}, {}t = {:.4g}, s = {:.4g} and the initial "
      "position ({:.4g}, {:.4g}, {:.4g})",
      at.pressure, at.speed, at.depth, at.friction_power,
      with_mean ? fmt::format("q_mean = {:.4g}, ", at.mean_friction_power) : "", at.moment.time,
      at.moment.slid, at.initial[0], at.initial[1], at.initial[2]);
}

/// Whether the law has a rate there. It need not where material is worn off: how deep a run comes
/// is for the law itself to say, p * v * (1 - h / h0) never comes to h0. If one does, the run
/// tells.
bool has_rate(const WearLaw& law, const WearInput& at) {
  try {
    law.rate(at);
    return true;
  } catch (const RecoverableError&) {
    return false;
  }
}

/// Multiples of f p v at the mean pressure for the mean of q over the contact.
std::vector<double> multiples_of_mean(const WearLaw& law) {
  return law.reads_mean() ? std::vector<double>{1, 10, 0.1, 1e-4} : std::vector<double>{1};
}

/// Times of the run at which a law is looked at, and one in each part between its breakpoints.
std::vector<double> moments(const WearLaw& law, double duration) {
  constexpr std::size_t most_parts = 100;
  std::vector<double> times;
  for (const double part : {0.0, 1e-3, 0.1, 0.5, 1.0}) times.push_back(part * duration);
  std::vector<double> ends = law.breakpoints();
  ends.resize(std::min(ends.size(), most_parts));
  double before = 0;
  for (const double end : ends) times.push_back((before + std::exchange(before, end)) / 2);
  return times;
}

}  // namespace

void check_wear_law(const WearLaw& law, const WearRange& range, const std::string& where) {
  constexpr double rounding = 1e-9;  // of the rate at the mean pressure
  WearInput at;
  const auto rate = [&] {
    try {
      return law.rate(at).value;
    } catch (const RecoverableError& error) {
      throw InputError(fmt::format(
          "{}: expected a finite wear rate of zero or more, with finite derivatives: {}", where,
          error.what()));
    }
  };
  for (const double time : moments(law, range.duration))
    for (const double speed : {0.5, 1.0, 2.0})
      for (const double depth : {0.0, 0.01, 0.3, 1.0, 2.0})
        for (const auto& initial : range.initial) {
          at.moment = {time, time * range.nominal_speed, time};
          at.speed = speed * range.speed;
          at.depth = depth * range.depth;
          at.initial = initial;
          for (const double mean : multiples_of_mean(law)) {
            double usual = 0;  // at the mean pressure
            for (const double pressure : {10.0, 3.0, 1.0, 0.3, 0.01, 1e-4, 0.0}) {
              at.pressure = pressure * range.pressure;
              at.friction_power = range.friction * at.pressure * at.speed;
              // What wears without pressure in a contact that has some is left out (WearLaw).
              at.mean_friction_power =
                  pressure == 0 ? 0 : mean * range.friction * range.pressure * at.speed;
              if (depth > 0 && !has_rate(law, at)) continue;
              const double value = rate();
              if (pressure == 1) usual = value;
              if (pressure == 0 && !(value <= rounding * usual))
                throw InputError(
                    fmt::format("{}: expected no wear without pressure, got the rate {:.4g} at {}",
                                where, value, described(at, law.reads_mean())));
            }
          }
        }
}

std::string remark_on_idle_law(const WearLaw& law, const WearRange& range) {
  const auto rate = [&](double pressure, double depth, double time, const auto& place) {
    WearInput at{.pressure = pressure * range.pressure,
                 .speed = range.speed,
                 .depth = depth * range.depth,
                 .moment = {time, time * range.nominal_speed, time},
                 .initial = place};
    at.friction_power = at.mean_friction_power = range.friction * at.pressure * at.speed;
    return depth == 0 || has_rate(law, at) ? law.rate(at) : WearRate{};
  };
  double idle = 0;  // the largest multiple of the mean pressure at which nothing wears
  for (const double pressure : {1.0, 3.0, 10.0}) {
    bool wears = false;
    for (const double time : moments(law, range.duration))
      for (const double depth : {0.0, 0.3})
        for (const auto& place : range.initial) {
          if (wears && &place != &range.initial.front()) break;
          const WearRate found = rate(pressure, depth, time, place);
          if (range.friction == 0 && found.by_friction_power != 0)
            return "the wear law reads q = f p v, which is 0: friction.coefficient is 0";
          wears |= found.value > 0;
        }
    if (wears) break;
    idle = pressure;
  }
  if (idle == 0 || range.speed == 0) return {};  // what slides by elastic strains has no speed yet
  return fmt::format(
      "the wear law is 0 at pressures up to {:.3g} MPa, {}the mean of about {:.3g} MPa: {} wears",
      idle * range.pressure, idle == 1 ? "" : fmt::format("{:g} times ", idle), range.pressure,
      idle < 10 ? "only what carries more" : "perhaps nothing");
}

}  // namespace gnomon
