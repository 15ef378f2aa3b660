// The settings of a run from the `integrator.*` and `output.*` keys of a scene.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/same_time.hpp>
#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/run/run.hpp>
#include <limits>
#include <sstream>

#include "run/store_schedule.hpp"

namespace gnomon {

void require_apart(const std::vector<double>& times, const std::string& where) {
  constexpr double least = 1e-5;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (times[k] - times[k - 1] < least * times[k])
      throw InputError(
          fmt::format("{}: expected times (including time.end) at least {:g} of their value apart, "
                      "got {} and {}",
                      where, least, times[k - 1], times[k]));
}

namespace {

/// The multiples of output.interval up to the end. Near to a time that is there, it is not
/// repeated: with interval = 0.1 and times = [0.3], 3 * 0.1 is another number.
void add_multiples(const Scene& scene, double end, std::vector<double>& times) {
  constexpr double most = 1e5;
  if (!scene.has("output.interval")) return;
  const double interval = scene.real("output.interval");
  if (end / interval > most)
    throw InputError(
        fmt::format("{}: expected {:g} s or more, which stores {:g} times up to time.end, got {:g}",
                    scene.where("output.interval"), end / most, most, interval));
  const std::vector<double> given = times;
  for (long k = 1; k * interval <= end * (1 + 1e-12); ++k) {
    const double time = k * interval;
    if (std::none_of(given.begin(), given.end(), [&](double t) { return same_time(t, time); }))
      times.push_back(time);
  }
}

/// "wear_depth > 1.0", of time.until; an empty text is none.
std::optional<Until> read_until(const Scene& scene) {
  if (!scene.has("time.until") || scene.text("time.until").empty()) return std::nullopt;
  Until until{scene.text("time.until"), scene.where("time.until"), {}};
  const std::size_t sign = std::min(until.text.find_first_of("<>"), until.text.size());
  until.above = until.text.substr(sign, 1) == ">";
  std::istringstream words(until.text.substr(0, sign)), number(until.text.substr(sign).erase(0, 1));
  std::string word, rest;
  while (words >> word) until.observation += (until.observation.empty() ? "" : " ") + word;
  if (until.observation.empty() || !(number >> until.value) || number >> rest)
    throw InputError(
        fmt::format("{}: expected an observation, > or <, and a number, as in \"worn_volume > "
                    "2.5\", got \"{}\"",
                    until.where, until.text));
  return until;
}

}  // namespace

namespace {

/// A force that is the value but for rounding is not beyond it.
double beyond(const Until& until, double value) {
  constexpr double rounding = 1e-12, least = std::numeric_limits<double>::min();
  const double over = until.above ? value - until.value : until.value - value;
  return over > rounding * std::abs(until.value) ? over : std::min(over, -least);
}

}  // namespace

double excess(const Until& until, const Observation& observed) {
  std::vector<std::string> names;
  for (const Scalar& scalar : observed) {
    if (scalar.name == until.observation) return beyond(until, scalar.value);
    names.push_back(scalar.name);
  }
  const std::string near = nearest_name(until.observation, names);
  throw InputError(
      fmt::format("{}: no observation is called {}, {}", until.where, until.observation,
                  near.empty() ? fmt::format("expected one of {}", fmt::join(names, ", "))
                               : fmt::format("did you mean {}?", near)));
}

double part_until(double before, double after, double steps) {
  const double shortly = 1e-3 * steps;
  constexpr double least = 0.1;  // of what does not jump
  const double secant = before / (before - after), part = secant < least ? 0.5 : secant;
  return part > 1 - shortly ? 1 : part + shortly / 2;
}

StorePolicy store_policy(const Scene& scene) {
  const double end = scene.real("time.end");
  StorePolicy policy;
  policy.every = scene.integer("output.every");
  policy.times = scene.reals("output.times");
  add_multiples(scene, end, policy.times);
  for (double& time : policy.times)
    if (same_time(time, end)) time = end;
  policy.until = read_until(scene);
  policy.checkpoint_seconds = scene.real("output.checkpoint_seconds");
  policy.phase_errors = scene.flag("output.phase_errors");
  std::sort(policy.times.begin(), policy.times.end());
  policy.times.erase(std::unique(policy.times.begin(), policy.times.end()), policy.times.end());
  const auto behind = std::upper_bound(policy.times.begin(), policy.times.end(), end);
  policy.beyond.assign(behind, policy.times.end());
  policy.times.erase(behind, policy.times.end());
  std::vector<double> landings = policy.times;
  if (landings.empty() || landings.back() != end) landings.push_back(end);
  require_apart(landings,
                scene.where(scene.has("output.interval") ? "output.interval" : "output.times"));
  // The start is always stored.
  if (!policy.times.empty() && policy.times.front() == 0) policy.times.erase(policy.times.begin());
  return policy;
}

std::string dropped_times_text(const Scene& scene) {
  const std::vector<double> beyond = store_policy(scene).beyond;
  if (beyond.empty()) return {};
  return fmt::format(
      "{} of output.times, from {:g} s on, {} after time.end = {:g} s and {} not stored",
      beyond.size(), beyond.front(), beyond.size() == 1 ? "lies" : "lie", scene.real("time.end"),
      beyond.size() == 1 ? "is" : "are");
}

namespace {

/// Of other methods; their defaults are in earlier results.
void refuse_foreign_keys(const Scene& scene, const Integrator& chosen) {
  for (const Integrator& other : Integrators::all())
    for (const Key& key : other.keys)
      if (scene.knows(key.name) && !scene.is_default(key.name) &&
          std::ranges::find(chosen.keys, key.name, &Key::name) == chosen.keys.end())
        throw InputError(fmt::format("{}: expected none, {} does not read it ({} does)",
                                     scene.where(key.name), chosen.name, other.name));
}

}  // namespace

const Integrator& chosen_integrator(const Scene& scene) {
  const Integrator& integrator = Integrators::find(scene.text("integrator.name"), "integrator");
  refuse_foreign_keys(scene, integrator);
  if (scene.has("integrator.step") && !integrator.fixed_steps)
    throw InputError(fmt::format(
        "{}: expected none, {} chooses its own steps (integrator.max_step bounds them), got {:g}",
        scene.where("integrator.step"), integrator.name, scene.real("integrator.step")));
  if (scene.text("integrator.events") == "locate" && !integrator.locates_events)
    throw InputError(
        fmt::format("{}: expected \"ignore\", {} does not locate events, got \"locate\"",
                    scene.where("integrator.events"), integrator.name));
  return integrator;
}

IntegratorSettings integrator_settings(const Scene& scene, const Model& model) {
  IntegratorSettings settings =
      controlled_settings(model, scene.real("integrator.rtol"), scene.real("time.end"));
  settings.step = scene.real_if("integrator.step").value_or(0.0);
  settings.atol = scene.real_if("integrator.atol").value_or(settings.atol);
  settings.nonlinear_fraction = scene.real("integrator.nonlinear_fraction");
  if (const auto given = scene.real_if("integrator.max_step"))
    settings.max_step = settings.max_step > 0 ? std::min(*given, settings.max_step) : *given;
  settings.locate_events = scene.text("integrator.events") == "locate";
  settings.stop_unstable = scene.text("integrator.unstable") == "stop";
  const Integrator& integrator = chosen_integrator(scene);
  for (const Key& key : integrator.keys) settings.own[key.name] = scene.any(key.name);
  if (!scene.flag("output.settle") || !integrator.settles) return settings;
  settings.settled = store_policy(scene).times;
  if (settings.settled.empty() || settings.settled.back() < settings.end)
    settings.settled.push_back(settings.end);
  return settings;
}

}  // namespace gnomon
