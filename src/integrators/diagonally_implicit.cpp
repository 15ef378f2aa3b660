#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/diagonally_implicit.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <utility>

namespace gnomon {

namespace {

/// Two steps of implicit Euler, half of h each. With the rates k_1 and k_2 at their ends, their
/// errors add up to h/2 (k_2 - k_1): the first has damped the stiff components, so that their rates
/// before it do not matter.
const ButcherTable two_euler_steps = {"two steps of implicit Euler",
                                      1,
                                      Eigen::MatrixXd{{0.5, 0.0}, {0.5, 0.5}},
                                      Eigen::VectorXd{{0.5, 0.5}},
                                      Eigen::VectorXd{{0.5, 1.0}},
                                      1,
                                      Eigen::VectorXd{{1.0, 0.0}}};

/// The part of kappa that each solve gets. An error e of d in stage j is an error e / (h a_jj) of
/// its rate, and so b_j / a_jj e of d at the end of the step (if stiff components do not damp it,
/// the largest case). If the sum of these factors is large, every stage has to be more accurate.
/// kappa belongs to the sum of esdirk-4.
double fraction_of_a_solve(const ButcherTable& table) {
  constexpr double usual = 5;
  double sum = 0;
  for (int j = table.explicit_first_stage() ? 1 : 0; j < table.stages(); ++j)
    sum += std::abs(table.b[j]) / table.A(j, j);
  return std::min(1.0, usual / sum);
}

}  // namespace

DiagonallyImplicit::DiagonallyImplicit(const System& system, const IntegratorSettings& settings,
                                       Counters& counters, ButcherTable table)
    : system_(system),
      counters_(counters),
      table_(std::move(table)),
      norm_(system.structure(), settings),
      error_control_(settings.step == 0),
      integrand_(settings.integrand),
      short_step_(1e-6 * settings.end),
      newton_(system.structure(), counters,
              within_time_error(modified_newton,
                                fraction_of_a_solve(table_) * settings.nonlinear_fraction)),
      k_(std::max(table_.stages(), two_euler_steps.stages()), Rates(norm_.components().size())),
      base_(norm_.components().size()),
      error_(norm_.components().size()) {}

void DiagonallyImplicit::accept(const State& state, bool kink) {
  if (kink) dense_output_.clear();
  dense_output_.add(state.t, state.y);
  if (!settled_) {
    t_old_ = t_new_;
    std::swap(rate_old_, rate_new_);
  }
  t_new_ = state.t;
  rate_new_.resize(base_.size());
  for (std::size_t k = 0; k < base_.size(); ++k) rate_new_[k] = state.ydot[norm_.components()[k]];
}

std::vector<double> DiagonallyImplicit::memory() const {
  if (table_.embedded_order > 0) return {};
  std::vector<double> memory = {double(!rate_old_.empty()), t_old_};
  pack(memory, rate_old_.empty() ? Rates(base_.size()) : rate_old_);
  return memory;
}

void DiagonallyImplicit::restore(std::span<const double> memory) {
  if (table_.embedded_order > 0) return;
  Unpacker numbers(memory);
  const bool known = numbers.one() != 0;
  t_old_ = numbers.one();
  rate_old_ = known ? numbers.many<double>(base_.size()) : Rates();
}

void DiagonallyImplicit::set_rates_of(double step, const Rates& base, std::span<const double> y,
                                      std::span<double> ydot) const {
  const auto& components = norm_.components();
  for (std::size_t k = 0; k < components.size(); ++k)
    ydot[components[k]] = (y[components[k]] - base[k]) / step;
}

/// One solve of F(t, y, (d - base) / step) = 0 from the guess to.y. F is that of the step that
/// starts at `from`, also past its end: some tables have a stage there, and the load may have a
/// breakpoint between.
NewtonReport DiagonallyImplicit::solve(double t, double step, const Rates& base, const State& from,
                                       const AttemptOptions& options, State& to) {
  NonlinearFunction function;
  function.residual = [&](std::span<const double> y, std::span<double> G) {
    set_rates_of(step, base, y, to.ydot);
    system_.residual({t, y, to.ydot, options.branch, from.t}, G);
  };
  function.jacobian = [&](std::span<const double> y, std::span<double> values) {
    set_rates_of(step, base, y, to.ydot);
    system_.jacobian({t, y, to.ydot, options.branch, from.t, &slow_}, 1 / step, values);
  };
  function.slow = &slow_;
  function.branch = [&](std::span<const double> y) {
    return options.branch ? *options.branch : active_set(system_, t, y);
  };
  function.rate_weight = 1 / step;
  function.switch_node = system_.structure().switch_node;
  if (options.error > 0)
    function.distance = [&](std::span<const double> before, std::span<const double> y) {
      return norm_.distance(before, y, from.y) / options.error;
    };
  NewtonReport report = newton_.solve(function, to.y);
  if (report.converged) set_rates_of(step, base, to.y, to.ydot);
  return report;
}

/// The same by continuation from step zero, where the solution is the state that the step starts
/// from: `base` and the time move from there with the step, by a quarter of it at first; each
/// success multiplies this part by 1.5, each failure by 0.5. It fails if a part of `least` is still
/// too long, and after `most` solves, because the progress may be too slow.
std::string DiagonallyImplicit::continue_in_step(double t, double step, const Rates& base,
                                                 const State& from, const AttemptOptions& options,
                                                 State& to) {
  constexpr double least = 1e-4;
  constexpr int most = 50;
  std::vector<double> good = from.y;
  Rates partial(base.size());
  double reached = 0, increment = 0.25;
  std::string reason;
  for (int solves = 1; reached < 1; ++solves) {
    const double part = std::min(1.0, reached + increment);
    for (std::size_t k = 0; k < base.size(); ++k) {
      const double start = from.y[norm_.components()[k]];
      partial[k] = start + part * (base[k] - start);
    }
    to.y = good;
    const double at = from.t + part * (t - from.t);
    const NewtonReport report = solve(at, part * step, partial, from, options, to);
    if (report.converged) {
      good = to.y;
      reached = part;
      increment *= 1.5;
    } else {
      reason = report.reason;
      increment /= 2;
    }
    if (reached < 1 && (solves == most || increment < least))
      return fmt::format("{} (continuation in the step reached {:.3g} of it)", reason, reached);
  }
  return {};
}

std::string DiagonallyImplicit::solve_stage(const ButcherTable& table, int i, const State& from,
                                            double h, const AttemptOptions& options, State& to) {
  const double t = from.t + table.c[i] * h, step = table.A(i, i) * h;
  for (std::size_t k = 0; k < base_.size(); ++k) {
    base_[k] = from.y[norm_.components()[k]];
    for (int j = 0; j < i; ++j) base_[k] += h * table.A(i, j) * k_[j][k];
  }
  // A polynomial does not predict how stiff components settle.
  if (!options.settles) dense_output_.evaluate(t, to.y);
  const NewtonReport report = solve(t, step, base_, from, options, to);
  if (report.converged) return {};
  if (!options.continuation) return report.reason;
  return continue_in_step(t, step, base_, from, options, to);
}

Attempt DiagonallyImplicit::attempt(const State& from, double h, const AttemptOptions& options,
                                    State& to) {
  to.t = from.t + h;
  to.y = from.y;
  to.ydot.assign(from.y.size(), 0.0);
  settled_ = options.settles;
  const ButcherTable& table = settled_ ? two_euler_steps : table_;
  const auto& components = norm_.components();
  Attempt whole{.success = true};
  double integral = 0;
  for (int i = 0; i < table.stages(); ++i) {
    const bool is_state = i == 0 && table.explicit_first_stage();
    if (!is_state) {
      std::string reason = solve_stage(table, i, from, h, options, to);
      if (!reason.empty()) return {.reason = std::move(reason)};
      dense_output_.add(from.t + table.c[i] * h, to.y);
      if (error_control_ && !options.branch) add_error_of_jumps(from, h, table.c[i], to, whole);
    }
    const std::vector<double>& rates = is_state ? from.ydot : to.ydot;
    for (std::size_t k = 0; k < components.size(); ++k) k_[i][k] = rates[components[k]];
    if (!integrand_ || table.b[i] == 0) continue;
    const Point stage =
        is_state
            ? Point{from.t, from.y, from.ydot, options.branch ? options.branch : from.own_branch()}
            : Point{from.t + table.c[i] * h, to.y, to.ydot, options.branch, from.t};
    integral += h * table.b[i] * integrand_(stage);
  }
  if (!table.stiffly_accurate()) {
    dense_output_.evaluate(to.t, to.y);
    for (std::size_t k = 0; k < components.size(); ++k) {
      double& d = to.y[components[k]] = from.y[components[k]];
      for (int i = 0; i < table.stages(); ++i) d += h * table.b[i] * k_[i][k];
    }
    const double t = inside_step(system_.structure(), from.t, to.t);
    if (!algebraic_) algebraic_.emplace(system_, counters_);
    std::string reason = algebraic_->solve(t, to.y, options.branch);
    if (!reason.empty()) return {.reason = std::move(reason)};
    set_rates(system_, options.branch, to, from.t);
  } else if (h < short_step_) {
    set_rates(system_, options.branch, to);  // a difference over so short a step is only rounding
  }
  whole.error = std::max(whole.error, estimate(table, from, h, to));
  whole.integral = integral;
  return whole;
}

/// A stage may lie beyond a jump that the step ends before.
void DiagonallyImplicit::add_error_of_jumps(const State& from, double h, double part,
                                            const State& stage, Attempt& whole) const {
  if (std::ranges::count(system_.structure().switch_jumps, 1) == 0) return;
  State at = stage;
  at.t = from.t + part * h;
  const JumpError jumps = error_of_jumps(system_, norm_, from, at, h);
  if (jumps.error <= whole.error) return;
  whole.error = jumps.error;
  whole.shorter = jumps.shorter;
}

double DiagonallyImplicit::estimate(const ButcherTable& table, const State& from, double h,
                                    const State& to) {
  const auto& components = norm_.components();
  if (table.embedded_order > 0) {
    for (std::size_t k = 0; k < components.size(); ++k) {
      error_[k] = 0;
      for (int i = 0; i < table.stages(); ++i)
        error_[k] += h * (table.b[i] - table.b_embedded[i]) * k_[i][k];
    }
    return norm_(error_, to.y);
  }
  const double alpha = table.A(table.stages() - 1, table.stages() - 1);
  // Before there are three rates, the difference from the explicit Euler method is used.
  const bool has_history = !rate_old_.empty() && t_old_ < from.t;
  const double first = has_history ? 0.5 - alpha : 0.5;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const double change = to.ydot[components[k]] - from.ydot[components[k]];
    error_[k] = first * h * change;
    if (!has_history) continue;
    const double before = (rate_new_[k] - rate_old_[k]) / (from.t - t_old_);
    error_[k] -= h * h * h / 6 * (change / h - before) / (from.t + h - t_old_);
  }
  return norm_(error_, to.y);
}

std::unique_ptr<Stepper> make_diagonally_implicit(const System& system,
                                                  const IntegratorSettings& settings,
                                                  Counters& counters, const ButcherTable& table) {
  const bool trapezoidal = table.embedded_order == 0 && table.order == 2;
  const int error_order = table.embedded_order > 0 ? std::min(table.order, table.embedded_order)
                                                   : (trapezoidal ? 2 : 1);
  return std::make_unique<OneStepStepper>(
      system, settings, counters,
      std::make_unique<DiagonallyImplicit>(system, settings, counters, checked_table(table)),
      table.order, error_order);
}

}  // namespace gnomon
