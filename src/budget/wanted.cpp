#include "budget/wanted.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/plan.hpp>
#include <map>

#include "budget/companions.hpp"
#include "budget/trade.hpp"

namespace gnomon {

namespace budget {

namespace {

/// Goals::values, by the words of accuracy.of.
const std::map<std::string, std::vector<std::string>> wanted_names = {
    {"depth", {"wear_depth"}},
    {"volume", {"worn_volume"}},
    {"profile", {"profile"}},
    {"width", {"contact_half_width", "contact_area"}},
    {"pressure", {"mean_pressure", "inner_pressure"}},
    {"largest_pressure", {"max_pressure"}},
    {"approach", {"approach"}}};

}  // namespace

double read_within(const Scene& scene) {
  if (const auto within = scene.real_if("accuracy.within")) return *within;
  throw InputError(scene.path().string() +
                   ": expected accuracy.within, the error that the result may have");
}

std::vector<std::size_t> wanted_places(const Scene& scene, const std::vector<Scalar>& values) {
  std::vector<std::size_t> places;
  if (scene.texts("accuracy.of").empty())
    throw InputError(scene.where("accuracy.of") + ": expected at least one word, got none");
  for (const std::string& word : scene.texts("accuracy.of")) {
    const std::vector<std::string>& names = wanted_names.at(word);
    const std::size_t before = places.size();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::ranges::find(names, values[i].name) != names.end() && values[i].value != 0)
        places.push_back(i);
    if (places.size() == before && scene.is_set("accuracy.of"))
      throw InputError(fmt::format("{}: expected values that are not zero in this scene, got {}",
                                   scene.where("accuracy.of"), word));
  }
  if (places.empty())
    throw InputError(scene.path().string() +
                     ": accuracy.within: expected depth, volume or pressure that are not zero");
  return places;
}

std::vector<std::size_t> without_ends(const std::vector<std::size_t>& places,
                                      const std::vector<Scalar>& values) {
  static const std::vector<std::string> of_ends = {"contact_half_width", "contact_area",
                                                   "mean_pressure", "max_pressure"};
  std::vector<std::size_t> left;
  for (const std::size_t i : places)
    if (std::ranges::find(of_ends, values[i].name) == of_ends.end()) left.push_back(i);
  return left.empty() ? places : left;
}

double assumed(double error) {
  return std::isnan(error) ? 1 : std::abs(error);
}

double largest(const std::vector<double>& errors, const std::vector<std::size_t>& places) {
  double result = 0;
  for (const std::size_t i : places) result = std::max(result, assumed(errors[i]));
  return result;
}

}  // namespace budget

namespace {

using namespace budget;

/// Of one value, but for parts of which nothing is known.
double sum_of_parts(const Budget& shown, std::size_t place) {
  double sum = 0;
  for (const BudgetPart& part : shown.parts)
    if (part.unknown.empty()) sum += assumed(part.errors[place]);
  return sum;
}

/// What can be done about the errors that a run has shown.
struct Repair {
  Trade trade;
  std::string mesh, phases;  ///< keys to change; empty: none
};

/// Whether a key judges a mesh that stays as it is, as mesh.split does.
bool judges_only(const Scene& scene, const std::string& key) {
  const std::vector<Key> keys = scene.controlling_keys();
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found != keys.end() && found->controls->judges_only;
}

Repair repair_of(const Plan& plan, const Scene& asked, const Budget& shown) {
  constexpr double phases_part = 0.3;  // of what may be: more of it calls for more phases
  const std::vector<std::size_t> places = wanted_places(asked, shown.values);
  Repair repair;
  repair.trade.seconds = 1;
  for (const BudgetPart& part : shown.parts) {
    if (!part.unknown.empty()) continue;
    const double error = largest(part.errors, places);
    const bool is_free =
        !asked.is_set(part.key) && !judges_only(asked, part.key) &&
        std::ranges::find(plan.known, part.key, &BudgetPart::key) == plan.known.end();
    if (part.source == ErrorSource::time && is_free) {
      repair.trade.time = error;
      repair.trade.free_time = true;
    } else if (part.source == ErrorSource::mesh && is_free) {
      repair.mesh = part.key;
      repair.trade.mesh = error;
      repair.trade.free_mesh = true;
    } else if (part.source == ErrorSource::phases && is_free &&
               error > phases_part * asked.real("accuracy.within")) {
      repair.phases = part.key;
      repair.trade.rest += error / 4;
    } else {
      repair.trade.rest += error;
    }
  }
  return repair;
}

}  // namespace

Budget find_budget(const Plan& plan, const Scene& scene, const Goals& goals, BudgetHooks hooks) {
  hooks.sources = {ErrorSource::mesh, ErrorSource::time, ErrorSource::phases};
  for (const BudgetPart& part : plan.known) std::erase(hooks.sources, part.source);
  Budget budget = find_budget(scene, goals, hooks);
  budget.parts.insert(budget.parts.end(), plan.known.begin(), plan.known.end());
  return budget;
}

double wanted_error(const Scene& scene, const Budget& budget) {
  double error = 0;
  for (const std::size_t i : wanted_places(scene, budget.values))
    error = std::max(error, sum_of_parts(budget, i));
  return error;
}

namespace {

/// The largest error of a wanted value, and the part of the budget that contributes most to it.
struct Worst {
  std::size_t place = 0;
  double error = 0;
  double told = 0;  ///< without parts that cannot be told of this value
  const BudgetPart* part = nullptr;
};

Worst worst_of(const Scene& asked, const Budget& shown) {
  Worst worst;
  for (const std::size_t i : wanted_places(asked, shown.values))
    if (const double sum = sum_of_parts(shown, i); sum >= worst.error)
      worst.error = sum, worst.place = i;
  double most = -1;
  for (const BudgetPart& part : shown.parts) {
    if (!part.unknown.empty()) continue;
    const double error = part.errors[worst.place];
    if (!std::isnan(error)) worst.told += error;
    if (assumed(error) > most) most = assumed(error), worst.part = &part;
  }
  return worst;
}

std::string unknown_parts(const Budget& shown) {
  std::string text;
  for (const BudgetPart& part : shown.parts)
    if (!part.unknown.empty())
      text += fmt::format(", without that of {} ({})", part.key, part.unknown);
  return text;
}

/// "0.41 %", or why not.
std::string reached_text(const Worst& worst, double within, bool without_parts) {
  if (worst.part && std::isnan(worst.part->errors[worst.place])) return "not known";
  const std::string reached = fmt::format("{:.2g} %", 100 * worst.error);
  if (without_parts) return "more than " + reached;
  const bool looks_met = reached == fmt::format("{:.2g} %", 100 * within);
  return worst.error > within && looks_met ? "a little more than " + reached : reached;
}

}  // namespace

std::string accuracy_text(const Scene& asked, const Budget& shown) {
  const Worst worst = worst_of(asked, shown);
  const std::string without = unknown_parts(shown);
  const double within = asked.real("accuracy.within");
  const bool may_be_more = worst.error > within || !without.empty();
  return fmt::format("asked for {:.2g} % in {}: {}, that of {}, mostly by {}{}{}", 100 * within,
                     fmt::join(asked.texts("accuracy.of"), ", "),
                     reached_text(worst, within, !without.empty()), shown.values[worst.place].name,
                     worst.part ? worst.part->key : "nothing", without,
                     worst.told > within ? "; this is NOT within it"
                     : may_be_more       ? "; whether this is within it is not known"
                                         : "");
}

std::string finer_text(const Scene& asked, const Scene& settings, const Budget& shown) {
  const Worst worst = worst_of(asked, shown);
  if (!(worst.error > asked.real("accuracy.within")) || !worst.part) return "";
  for (const Key& key : settings.controlling_keys())
    if (key.name == worst.part->key)
      if (const auto finer = key.controls->scaled(settings, Finer(worst.part->source).factor))
        return change_text(settings, *finer);
  return "";
}

std::optional<Scene> refined(const Plan& plan, const Scene& asked, const Scene& settings,
                             const Budget& shown, int runs) {
  const double within = asked.real("accuracy.within");
  constexpr double sure = 0.85;  // estimates are not
  constexpr int most = 3;
  if (runs == most || !(wanted_error(asked, shown) > (runs == 1 ? sure : 1) * within)) return {};
  const Repair repair = repair_of(plan, asked, shown);
  // What finer elements and steps cannot improve is no reason for them; and no more than half as
  // large elements at once, for estimates of large errors are rough.
  if (repair.trade.rest > 0.7 * within) return {};
  // The errors of a run are known better than those of pilots, for which half is used.
  constexpr double used = 0.75;
  Factors factors = cheapest(repair.trade, used * within, used * within / 4);
  factors.mesh = std::clamp(factors.mesh, 0.5, 1.0);
  factors.time = std::clamp(factors.time, 0.01, 1.0);
  if (factors.mesh == 1 && factors.time == 1 && repair.phases.empty()) return {};
  Scene scene = settings;
  const auto scale = [&scene](const Key& key, double factor) {
    scene = key.controls->scaled(scene, factor).value_or(scene);
  };
  for (const Key& key : settings.controlling_keys()) {
    if (key.name == repair.phases) scale(key, 0.5);
    if (key.name == repair.mesh) scale(key, factors.mesh);
    if (key.controls->source == ErrorSource::time) scale(key, factors.time);
  }
  if (Scene::differing_keys(settings, scene).empty()) return {};
  return scene;
}

}  // namespace gnomon
