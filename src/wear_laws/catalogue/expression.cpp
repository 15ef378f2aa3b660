#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/expressions/sign_changes.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <memory>
#include <optional>
#include <set>

#include "expressions/expression_tables.hpp"
#include "expressions/expression_text.hpp"

namespace gnomon {

const std::vector<std::string>& wear_law_variables() {
  static const std::vector<std::string> names = {"p", "v",  "h",  "q",  "t",
                                                 "s", "x0", "y0", "z0", "q_mean"};
  return names;
}

namespace {

using Variables = std::array<double, 10>;
constexpr std::size_t time_variable = 4, slid_variable = 5, mean_variable = 9;

Variables variables(const WearInput& at) {
  return {at.pressure,    at.speed,      at.depth,      at.friction_power, at.moment.time,
          at.moment.slid, at.initial[0], at.initial[1], at.initial[2],     at.mean_friction_power};
}

/// Steps end where a condition on time changes; between, it has one branch.
class ExpressionLaw {
public:
  ExpressionLaw(const Expression& rate, double end, double nominal_speed)
      : rate_(rate), end_(end), nominal_speed_(nominal_speed) {
    for (std::size_t kink = 0; kink < rate.kinks(); ++kink) {
      bool timed = true;
      for (std::size_t i = 0; i < wear_law_variables().size(); ++i)
        if (i != time_variable && i != slid_variable) timed &= !rate.kink_depends_on(kink, i);
      (timed ? timed_ : nodal_).push_back(kink);
    }
    find_breakpoints();
  }

  const std::vector<double>& breakpoints() const { return breakpoints_; }
  std::size_t nodal_kinks() const { return nodal_.size(); }
  std::vector<char> jumps() const {
    std::vector<char> result;
    for (const std::size_t kink : nodal_) result.push_back(rate_.kink_may_jump(kink));
    return result;
  }

  WearRate rate(const WearInput& at, std::span<const char> branches) const {
    const WearRate rate = rate_at(variables(at), at.moment.within, branches);
    if (std::isfinite(rate.value)) return rate;
    // Past the end of its step, where stages of some methods lie, sqrt(max(950 - t, 0)) is
    // continued by what it is at the end.
    const auto next = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), at.moment.within);
    const double end = next == breakpoints_.end() ? end_ : *next;
    if (at.moment.time <= end) return rate;
    Variables x = variables(at);
    x[time_variable] = end, x[slid_variable] = nominal_speed_ * end;
    return rate_at(x, at.moment.within, branches);
  }

  void switching(const WearInput& at, std::span<const char> branches,
                 std::span<double> values) const {
    const Variables x = variables(at);
    const std::vector<char> all = all_branches(x, at.moment.within, branches);
    std::vector<double> found(rate_.kinks());
    rate_.switching(x, found, all);
    for (std::size_t k = 0; k < nodal_.size(); ++k) values[k] = found[nodal_[k]];
  }

private:
  WearRate rate_at(const Variables& x, double within, std::span<const char> branches) const {
    Variables gradient{};
    const std::vector<char> all = all_branches(x, within, branches);
    double value = rate_.value_and_gradient(x, gradient, all);
    if (value < 0 && -value <= of_rounded_time(x, gradient)) value = 0;
    return {value, gradient[0], gradient[1], gradient[2], gradient[3], gradient[mean_variable]};
  }

  /// By how much a rate is another one at a time that is rounded: of max(sin(2*pi*t), 0) at t = 1.
  static double of_rounded_time(const Variables& x, const Variables& gradient) {
    constexpr double rounding = 1e-12;
    return rounding * (std::abs(gradient[time_variable] * x[time_variable]) +
                       std::abs(gradient[slid_variable] * x[slid_variable]));
  }

  std::vector<char> active(const Variables& x) const {
    std::vector<double> values(rate_.kinks());
    rate_.switching(x, values);
    std::vector<char> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(),
                   [](double value) { return static_cast<char>(value <= 0); });
    return result;
  }

  /// Of the kinks of the expression, from those of the law; empty: as x lies.
  std::vector<char> all_branches(const Variables& x, double within,
                                 std::span<const char> branches) const {
    if (timed_.empty() && (branches.empty() || nodal_.empty())) return {};
    std::vector<char> all = branches.empty() ? active(x) : std::vector<char>(rate_.kinks());
    if (!branches.empty())
      for (std::size_t k = 0; k < nodal_.size(); ++k) all[nodal_[k]] = branches[k];
    const auto behind = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), within);
    const auto& between = between_[static_cast<std::size_t>(behind - breakpoints_.begin())];
    for (const std::size_t kink : timed_) all[kink] = between[kink];
    return all;
  }

  void find_breakpoints() {
    const auto at = [&](double t) {
      Variables x;
      x.fill(1);
      x[time_variable] = t, x[slid_variable] = nominal_speed_ * t;
      return x;
    };
    breakpoints_ =
        sign_changes([&](double t, std::span<double> values) { rate_.switching(at(t), values); },
                     rate_.kinks(), timed_, end_);
    for (std::size_t k = 0; k <= breakpoints_.size(); ++k) {
      const double from = k == 0 ? 0 : breakpoints_[k - 1];
      const double to = k == breakpoints_.size() ? end_ : breakpoints_[k];
      between_.push_back(active(at((from + to) / 2)));
    }
  }

  Expression rate_;
  double end_, nominal_speed_;              // of the run
  std::vector<std::size_t> nodal_, timed_;  // kinks of the expression
  std::vector<double> breakpoints_;
  std::vector<std::vector<char>> between_;  // what is active between them, also at both ends
};

}  // namespace

WearLaw expression_wear_law(const Expression& rate, double end, double nominal_speed) {
  const auto law = std::make_shared<const ExpressionLaw>(rate, end, nominal_speed);
  return WearLaw(
      {.rate = [law](const WearInput& at,
                     std::span<const char> branches) { return law->rate(at, branches); },
       .kinks = law->nodal_kinks(),
       .switching = [law](const WearInput& at, std::span<const char> branches,
                          std::span<double> values) { law->switching(at, branches, values); },
       .breakpoints = law->breakpoints(),
       .jumps = law->jumps(),
       .in_time = rate.depends_on(time_variable) || rate.depends_on(slid_variable),
       .reads_mean = rate.depends_on(mean_variable)});
}

namespace {

/// Springs have no friction, and pairs may each have their own: none where these differ.
std::optional<double> friction_of(const Scene& scene) {
  if (!scene.knows("friction.coefficient")) return 0;
  std::set<double> found;
  for (const std::string& pair : scene.chosen_names("pair.#.bodies")) {
    const std::string own = "pair." + pair + ".friction";
    found.insert(scene.real(scene.given(own) ? own : "friction.coefficient"));
  }
  if (found.empty()) return scene.real("friction.coefficient");
  if (found.size() > 1) return std::nullopt;
  return *found.begin();
}

/// k, f, the constants and the tables of the scene.
ExpressionNames read_names(const Scene& scene) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  if (scene.has("wear.coefficient")) names.constants["k"] = scene.real("wear.coefficient");
  if (const auto friction = friction_of(scene)) names.constants["f"] = *friction;
  for (const std::string& name : scene.chosen_names("wear.constants.*")) {
    const std::string key = "wear.constants." + name;
    if (name == "k" || name == "f")
      throw InputError(scene.where(key) +
                       ": expected another name: k is wear.coefficient, f friction.coefficient");
    require_free_name(scene, key, name, names);
    names.constants[name] = scene.real(key);
  }
  add_tables(scene, names);
  return names;
}

void require_one_friction(const Scene& scene, const std::string& key) {
  if (tokens_in(scene.text(key)).contains("f") && !friction_of(scene))
    throw InputError(
        scene.where(key) +
        ": f is not one number, pair.#.friction differs: expected q, which is f p v of "
        "each pair");
}

/// Of p, v, h, q, q_mean or a position, each point is a switching function of every contact node;
/// of t or s, a breakpoint at which a step ends.
void require_few_points(const Scene& scene, const std::string& rate) {
  constexpr std::size_t most = 1000;
  for (const std::string& name : tokens_in(rate)) {
    const std::string x = "tables." + name + ".x";
    if (scene.knows(x) && scene.reals(x).size() > most)
      throw InputError(
          fmt::format("{}: expected at most {} points of a table in a wear rate, got {}",
                      scene.where(x), most, scene.reals(x).size()));
  }
}

}  // namespace

WearLaw expression_wear_law(const Scene& scene, const std::string& key, double nominal_speed) {
  const ExpressionNames names = read_names(scene);
  require_one_friction(scene, key);
  try {
    const Expression rate(scene.text(key), names);
    require_few_points(scene, rate.text());
    return expression_wear_law(rate, scene.real("time.end"), nominal_speed);
  } catch (const ExpressionError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

namespace {

const Registration<WearLawKind> registration(
    {.name = "expression",
     .help = "the expression wear.rate of p, v, h, q, t, s, x0, y0, z0, q_mean",
     .keys = {},
     .make = [](const Scene& scene) {
       return expression_wear_law(scene, "wear.rate", scene.real("wear.velocity"));
     }});

}  // namespace

}  // namespace gnomon
