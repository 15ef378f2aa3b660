#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/wear_laws/law_in_time.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <set>

#include "expressions/expression_text.hpp"

namespace gnomon {

namespace {

/// A law in C++ reads neither the expression nor its names: they count as used.
void require_no_expression(const Scene& scene, const std::string& rate_key) {
  const std::string& law = scene.text("wear.law");
  const auto refuse = [&](const std::string& key) {
    throw InputError(scene.where(key) + ": expected nothing: wear.law = \"" + law +
                     "\" does not read it");
  };
  if (rate_key != "wear.rate" || !scene.is_default(rate_key)) refuse(rate_key);
  if (const auto names = scene.chosen_names("wear.constants.*"); !names.empty())
    refuse("wear.constants." + names.front());
}

/// At most some hundred of them, the last among them.
std::vector<std::array<double, 3>> some_of(const std::vector<std::array<double, 3>>& positions) {
  constexpr std::size_t most = 200;
  if (positions.empty()) return {{}};
  const std::size_t stride = positions.size() / most + 1;
  std::vector<std::array<double, 3>> result = {positions.back()};
  for (std::size_t k = 0; k < positions.size(); k += stride) result.push_back(positions[k]);
  return result;
}

}  // namespace

WearLaw read_wear_law(const Scene& scene, std::optional<double> speed,
                      const std::string& rate_key) {
  require_coefficient(scene);
  const WearLawKind& kind = Registry<WearLawKind>::find(scene.text("wear.law"), "wear law");
  if (kind.name == "expression")
    return expression_wear_law(scene, rate_key, speed ? *speed : scene.real("wear.velocity"));
  require_no_expression(scene, rate_key);
  try {
    return kind.make(scene);
  } catch (const RegistrationError& error) {
    throw RegistrationError("the wear law \"" + kind.name + "\": " + error.what());
  }
}

namespace {

/// The key that gives the law.
std::string where_law(const Scene& scene, const std::string& rate_key = "wear.rate") {
  return scene.where(scene.text("wear.law") == "expression" ? rate_key : "wear.law");
}

using Places = std::vector<std::array<double, 3>>;

/// Multiples of the mean pressure, of which the first is taken at which a law wears.
constexpr std::array<double, 4> that_wear = {1, 3, 10, 30};

/// Wdot / p at a pressure that is that of the whole contact; of a rate that is proportional to it,
/// whatever the pressure, to the last digit.
double secant(const WearLaw& law, const WearCircumstances& at, double pressure,
              const Places::value_type& place, double t, double depth = 0) {
  constexpr double rounding = 1e-12;
  const double power = at.friction * pressure * at.speed;
  const WearRate rate = law.rate({.pressure = pressure,
                                  .speed = at.speed,
                                  .depth = depth,
                                  .friction_power = power,
                                  .mean_friction_power = power,
                                  .moment = {.time = t, .slid = at.speed * t, .within = t},
                                  .initial = place});
  const double secant = rate.value / pressure;
  const double slope = rate.by_pressure + (rate.by_friction_power + rate.by_mean_friction_power) *
                                              at.friction * at.speed;
  return std::abs(slope - secant) <= rounding * secant ? slope : secant;
}

/// Some of the positions, all over the surface, at which it has a rate in the middle of the run: a
/// law need not be defined everywhere.
Places places_of(const WearLaw& law, const WearCircumstances& at) {
  constexpr std::size_t most = 8;
  const std::size_t size = at.initial.size(), count = std::min(most, size);
  Places places;
  for (std::size_t k = 0; k < count; ++k) try {
      const auto& place = at.initial[(2 * k + 1) * size / (2 * count)];
      secant(law, at, at.pressure, place, at.duration / 2);
      places.push_back(place);
    } catch (const RecoverableError&) {
      continue;
    }
  if (places.empty()) places.push_back(size > 0 ? at.initial[size / 2] : Places::value_type{});
  return places;
}

}  // namespace

double wear_by_pressure(const WearLaw& law, const WearCircumstances& at) {
  constexpr int moments = 4096;  // middles of equal parts of the run
  const Places places = places_of(law, at);
  for (const double multiple : that_wear) {
    const auto at_moment = [&](int k) {
      return secant(law, at, multiple * at.pressure, places[k % places.size()],
                    at.duration * (k + 0.5) / moments);
    };
    const double first = at_moment(0);
    double difference = 0;  // so that equal ones have their mean to the last digit
    for (int k = 1; k < moments; ++k) difference += at_moment(k) - first;
    if (const double mean = first + difference / moments; mean > 0) return mean;
  }
  return 0;
}

/// By the time that a new surface takes, T(h), the integral over the depth h of its rate by that at
/// h, with the trapezoidal rule on a grid in logarithmic steps: a law may fall at any depth.
double depth_by_law(const WearLaw& law, const WearCircumstances& at, double nominal) {
  constexpr int moments = 16, decades = 12, parts = 16;
  const Places places = places_of(law, at);
  double pressure = 0;
  const auto rate = [&](double depth) {
    double sum = 0;
    for (int k = 0; k < moments; ++k)
      for (const auto& place : places) try {
          sum += secant(law, at, pressure, place, at.duration * (k + 0.5) / moments, depth);
        } catch (const RecoverableError&) {
          if (depth == 0) throw;  // it need not be defined beyond where it falls to zero
        }
    return sum;
  };
  double fresh = 0;
  for (const double multiple : that_wear) {
    pressure = multiple * at.pressure;
    if (fresh = rate(0); fresh > 0) break;
  }
  if (!(fresh > 0) || !(nominal > 0)) return nominal;
  double depth = 0, slowness = 1, taken = 0;
  bool slows = false;  // otherwise the depth is the nominal one to the last digit
  for (int k = -decades * parts; k <= 0; ++k) {
    const double next = nominal * std::pow(10.0, static_cast<double>(k) / parts),
                 slower = fresh / rate(next), time = (next - depth) * (slowness + slower) / 2;
    slows = slows || slower > 1;
    if (slows && taken + time > nominal) return depth + (next - depth) * (nominal - taken) / time;
    depth = next, slowness = slower, taken += time;
  }
  return nominal;
}

namespace {

WearCircumstances circumstances(const Scene& scene, double pressure) {
  return {.pressure = pressure,
          .friction = scene.real("friction.coefficient"),
          .speed = scene.real("wear.velocity"),
          .duration = scene.real("time.end")};
}

}  // namespace

double wear_by_pressure(const Scene& scene, const WearLaw& law, double pressure) try {
  return wear_by_pressure(law, circumstances(scene, pressure));
} catch (const RecoverableError& error) {
  throw unsound_law(scene, error);
}

double depth_by_law(const Scene& scene, const WearLaw& law, double pressure, double nominal) try {
  return depth_by_law(law, circumstances(scene, pressure), nominal);
} catch (const RecoverableError& error) {
  throw unsound_law(scene, error);
}

InputError unsound_law(const Scene& scene, const RecoverableError& error) {
  return InputError(
      where_law(scene) +
      ": expected a finite wear rate of zero or more, with finite derivatives: " + error.what());
}

namespace {

/// What steps see of a law that changes with time by itself. Refuses one whose changes they cannot
/// follow. `stops`: none where there would be too many.
std::string remark_on_time(const LawInTime& in_time,
                           const std::optional<std::vector<double>>& stops, double fixed_step,
                           const std::string& where) {
  constexpr double most = 0.05, right = 1e-2, parts = 16;
  const double resolution = in_time.resolution(), unseen = in_time.unseen_part(),
               fast = stops ? 0 : in_time.fast_part();
  if (unseen > most && fixed_step > 0 && fixed_step < resolution / parts) return {};
  if (std::max(unseen, fast) > most)
    throw InputError(fmt::format(
        "{}: expected changes with time that steps can follow; this rate changes by about {:.2g} "
        "of its mean within {:.3g} s: give its mean over time, or a shorter run",
        where, std::max(unseen, fast), resolution));
  if (!in_time.changes()) return {};
  if (!stops)
    return fmt::format(
        "the wear law changes with time by itself, by about {:.2g} of its mean within {:.3g} s, "
        "which steps do not follow",
        fast, resolution);
  if (fixed_step == 0)
    return fmt::format(
        "the wear law changes with time by itself: what lasts {:.3g} s or longer is found, and "
        "steps end at {} times for it; what is shorter may be stepped over",
        resolution, stops->size());
  const double missed = in_time.missed_by_steps(fixed_step);
  if (missed <= right) return {};
  return fmt::format(
      "the wear law changes with time faster than steps of {:g} s can follow: {:.2g} % of what it "
      "wears lies off parabolas through their ends and middles",
      fixed_step, 100 * missed);
}

/// All phases of a cycle have one time, and the law that of the run.
std::string remark_on_cycle(const Scene& scene, const LawInTime& in_time) {
  constexpr double much = 0.05;
  const auto period = scene.knows("cycle.period") ? scene.real_if("cycle.period") : std::nullopt;
  const double change = period ? in_time.change_within(*period) : 0;
  if (change < much) return {};
  return fmt::format(
      "the wear law changes with time by {:.2g} of its mean within cycle.period: all phases of a "
      "cycle have one time, so that the run has its mean over time times that of a cycle, and not "
      "what both make together",
      change);
}

}  // namespace

WearLaw required_law(const Scene& scene, const WearLaw& law, const WearCircumstances& at,
                     std::vector<std::string>& remarks, const std::string& rate_key) {
  if (law.reads_mean() && !at.rolls)
    throw InputError(
        where_law(scene, rate_key) +
        ": expected no q_mean, the mean of q over the contact, without steady rolling");
  const WearRange range{.pressure = at.pressure,
                        .speed = at.speed,
                        .depth = at.depth,
                        .duration = at.duration,
                        .friction = at.friction,
                        .nominal_speed = at.speed,
                        .initial = some_of(at.initial)};
  check_wear_law(law, range, where_law(scene, rate_key));
  const auto remark = [&](std::string text) {
    if (!text.empty()) remarks.push_back(std::move(text));
  };
  if (asks_for_wear(scene)) remark(remark_on_idle_law(law, range));
  const LawInTime in_time(law, range);
  const double step = scene.real_if("integrator.step").value_or(0);
  std::optional<std::vector<double>> stops = std::vector<double>();
  if (step == 0) stops = in_time.stops(scene.real("integrator.rtol"));
  remark(remark_on_time(in_time, stops, step, where_law(scene, rate_key)));
  remark(remark_on_cycle(scene, in_time));
  return in_time.changes() ? law.with_stops(std::move(stops).value_or(std::vector<double>())) : law;
}

namespace {

/// The names that the rates of a scene use.
std::set<std::string, std::less<>> names_in_rates(const Scene& scene) {
  std::set<std::string, std::less<>> used;
  const std::string surfaces = "wear.surfaces.";
  std::vector<std::string> rates = {scene.text("wear.rate")};
  for (const std::string& name : scene.chosen_names(surfaces + "\"*\".rate"))
    rates.push_back(scene.text(surfaces + name + ".rate"));
  for (const std::string& rate : rates) used.merge(tokens_in(rate));
  return used;
}

}  // namespace

bool reads_in_rates(const Scene& scene, const std::string& name) {
  return scene.text("wear.law") != "expression" || names_in_rates(scene).contains(name);
}

std::vector<std::string> unused_wear_names(const Scene& scene) {
  if (!scene.knows("wear.rate")) return {};
  auto used = names_in_rates(scene);
  std::vector<std::string> unused;
  for (const std::string& name : scene.chosen_names("wear.constants.*"))
    if (!used.contains(name)) unused.push_back("wear.constants." + name);
  for (const std::string& text : cycle_expressions(scene)) used.merge(tokens_in(text));
  const std::string factor = "friction.factor";
  if (scene.knows(factor) && scene.given(factor)) used.merge(tokens_in(scene.text(factor)));
  for (const std::string& name : scene.chosen_names("tables.*.x"))
    if (!used.contains(name)) unused.push_back("tables." + name);
  return unused;
}

}  // namespace gnomon
