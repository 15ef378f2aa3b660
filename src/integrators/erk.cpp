#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/integrators/dense_output.hpp>
#include <gnomon/integrators/diagonally_implicit.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/step_size.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <utility>

#include "integrators/erk_table.hpp"
#include "integrators/evaluated_stages.hpp"
#include "integrators/stability_limit.hpp"
#include "sundials/room.hpp"

namespace gnomon {

using namespace sundials;

namespace {
/// A number of failures in one step that is practically unlimited: a step is then a billionth of
/// its first size.
constexpr int most_failures = 30;

/// ERKStep on the differential components: y' = rate(t, y), where the rate follows from a solve of
/// the algebraic stages (AlgebraicSolver).
class ErkSolver : public Stepper {
public:
  ErkSolver(const System& system, const IntegratorSettings& settings, Counters& counters,
            ButcherTable table)
      : Stepper(counters),
        system_(system),
        settings_(settings),
        counters_(counters),
        table_(std::move(table)),
        norm_(system.structure(), settings),
        // Errors of contact problems enter times h, so that a part of the estimate is enough.
        expected_error_(settings, table_.embedded_order, table_.embedded_order),
        algebraic_(system, counters, settings.nonlinear_fraction),
        stability_(table_),
        evaluated_(table_),
        proposal_(settings.step),
        step_control_(pi_controller, context_),
        d_(make_vector(static_cast<long>(norm_.components().size()), context_)) {}
  std::vector<double> memory() const override { return {proposal_, stability_.memory()}; }
  void restore(const State&, std::span<const double> memory) override {
    if (memory.empty()) throw InputError("the checkpoint does not belong to this integrator");
    proposal_ = fixed() ? std::min(memory.front(), settings_.step) : memory.front();
    if (memory.size() > 1) stability_.restore(memory[1]);
  }
  /// The size of the steps remains; the controller of ARKODE begins anew.
  bool follow(Stepper& before, const State& state, bool) override {
    restore(state, before.memory());
    return true;
  }

private:
  bool fixed() const { return settings_.step > 0; }

  StepReport take_step(State& state, double t_stop) override {
    from_ = state.t;
    if (!erk_)
      begin(state);
    else if (is_behind_jump_)
      restart(state, proposal_);  // ERKStep has kept the rate before the jump
    remembered_.clear();
    for (const int i : system_.structure().remembered) remembered_.push_back(state.y[i]);
    void* erk = erk_.get();
    t_stop = end_of_smooth_part(system_.structure(), state.t, t_stop);
    if (!fixed()) t_stop = end_at_stop(system_.structure(), state.t, t_stop);
    sunrealtype t = state.t;
    for (int failures = 0;; ++failures) {
      set_step(state, t_stop);
      guard_.clear();
      t = state.t;
      const int flag = ARKodeEvolve(erk, t_stop, d_.get(), &t, ARK_ONE_STEP);
      const bool done = flag >= 0 && guard_.run([&] { evaluate(t, view(d_.get())); }) ==
                                         0;  // the state that it has reached
      guard_.rethrow();
      long error_fails = 0;
      check(ARKodeGetNumErrTestFails(erk, &error_fails), "ARKodeGetNumErrTestFails");
      counters_.rejected_steps += error_fails - std::exchange(rejected_, error_fails);
      if (done) {
        const double shorter =
            fixed() ? 0 : error_of_jumps(system_, norm_, state, whole_, t - state.t).shorter;
        if (shorter == 0) break;
        ++counters_.rejected_steps;
        restart(state, shorter);
        continue;
      }
      double tried = t - state.t;
      if (flag < 0) check(ARKodeGetCurrentStep(erk, &tried), "ARKodeGetCurrentStep");
      // Ever smaller steps would approach the end of the solution without reaching it.
      const bool shortest = tried <= shortest_step(settings_);
      if (guard_.recoverable().empty() || shortest || failures == most_failures)
        throw SolutionError(fmt::format(
            "{} cannot continue from t = {:.6g}: code {}{}{}", table_.name, state.t, flag,
            guard_.recoverable().empty() ? "" : "; last: ", guard_.recoverable()));
      ++counters_.rejected_steps;
      restart(state, std::min(tried, t_stop - state.t) / 2);
    }
    if (fixed())
      proposal_ = std::min(settings_.step, 2 * proposal_);
    else
      check(ARKodeGetCurrentStep(erk, &proposal_), "ARKodeGetCurrentStep");
    const StepReport report{
        .step = t - state.t, .order = table_.order, .integral = sum_up(state, t - state.t)};
    State behind = whole_;
    is_behind_jump_ = is_breakpoint(system_.structure(), behind.t) &&
                      pass_breakpoint(system_, settings_, counters_, nullptr, behind);
    state = std::move(behind);
    return report;
  }

  static int rate(sunrealtype t, N_Vector d, N_Vector ddot, void* data) {
    ErkSolver& self = *static_cast<ErkSolver*>(data);
    return self.guard_.run([&] {
      self.evaluate(t, view(d));
      self.gather(self.whole_.ydot, view(ddot));
      const double integrand = self.settings_.integrand ? self.integrand(self.whole_) : 0;
      self.evaluated_.add({t, integrand, {view(ddot).begin(), view(ddot).end()}});
    });
  }

  static int weights(N_Vector d, N_Vector w, void* data) {
    const ErkSolver& self = *static_cast<ErkSolver*>(data);
    for (std::size_t k = 0; k < view(d).size(); ++k)
      view(w)[k] = self.norm_.weight(self.norm_.components()[k], view(d)[k]);
    return 0;
  }

  void begin(const State& state) {
    set_state(state);
    erk_.reset(ERKStepCreate(&ErkSolver::rate, state.t, d_.get(), context_));
    void* erk = erk_.get();
    check(erk, "ERKStepCreate");
    GNOMON_SILENCE(ERKStepSetErrHandlerFn, erk);
    check(ARKodeSetUserData(erk, this), "ARKodeSetUserData");
    check(ERKStepSetTable(erk, table_with_end(table_).get()), "ERKStepSetTable");
    check(ARKodeWFtolerances(erk, &ErkSolver::weights), "ARKodeWFtolerances");
    check(step_control_.give_to(erk), "StepControl");
    check(ARKodeSetMaxGrowth(erk, most_growth), "ARKodeSetMaxGrowth");
    check(ARKodeSetMaxErrTestFails(erk, most_failures), "ARKodeSetMaxErrTestFails");
    check(ARKodeSetMaxNumSteps(erk, -1), "ARKodeSetMaxNumSteps");
    limit_steps();
    if (fixed()) return;
    if (proposal_ > 0)  // not the first step, which may be far too small
      check(ARKodeSetMaxFirstGrowth(erk, most_growth), "ARKodeSetMaxFirstGrowth");
    else
      proposal_ = first_step(state, system_.structure(), settings_, table_.embedded_order);
    check(ARKodeSetInitStep(erk, proposal_), "ARKodeSetInitStep");
  }

  /// Restarts after a failed evaluation: from the last good state with a shorter step.
  void restart(const State& state, double h) {
    set_state(state);
    check(ARKodeReset(erk_.get(), state.t, d_.get()), "ARKodeReset");
    if (fixed())
      proposal_ = h;
    else
      check(ARKodeSetInitStep(erk_.get(), h), "ARKodeSetInitStep");
  }
  void set_step(const State& state, double t_stop) {
    check(ARKodeSetStopTime(erk_.get(), t_stop), "ARKodeSetStopTime");
    step_ = std::min(proposal_, t_stop - state.t);
    if (!fixed()) return;
    const double left = end_of_fixed_step(state.t, settings_.step, t_stop) - state.t;
    step_ = proposal_ < left * (1 - shortest_remainder) ? proposal_ : left;
    check(ARKodeSetFixedStep(erk_.get(), step_), "ARKodeSetFixedStep");
  }

  /// Makes whole_ the consistent state with differential components d, including its rates.
  void evaluate(double t, std::span<const double> d) {
    whole_ = consistent(t, d);
    dense_output_.add(t, whole_.y);
  }
  State consistent(double t, std::span<const double> d) {
    State next = whole_;
    next.t = t;
    if (t != whole_.t) dense_output_.evaluate(t, next.y);
    const std::vector<int>& components = norm_.components();
    for (std::size_t k = 0; k < components.size(); ++k) next.y[components[k]] = d[k];
    const double error = expected_error_.of_step(step_);
    const Distance distance = [&](std::span<const double> before, std::span<const double> y) {
      return step_ * distance_of_rates(system_, norm_, nullptr, next, before, y, from_) / error;
    };
    if (t != whole_.t || norm_.distance(next.y, whole_.y, next.y) > 0) {
      for (std::size_t k = 0; k < remembered_.size(); ++k)
        next.y[system_.structure().remembered[k]] = remembered_[k];
      const auto solve = [&] {
        const std::string reason =
            algebraic_.solve(inside_step(system_.structure(), from_, t), next.y, nullptr,
                             error > 0 ? distance : Distance{});
        if (!reason.empty()) throw RecoverableError(reason);
      };
      solve();
      // Of what is remembered a small part of its change in the step is missing (slip_memory.hpp),
      // which is of first order; the second time, of that part.
      if (!remembered_.empty()) solve();
    }
    set_rates(system_, nullptr, next, from_);
    return next;
  }

  void gather(const std::vector<double>& y, std::span<double> d) const {
    const std::vector<int>& components = norm_.components();
    for (std::size_t k = 0; k < components.size(); ++k) d[k] = y[components[k]];
  }
  /// The state from which ERKStep begins, or begins again.
  void set_state(const State& state) {
    whole_ = state;
    dense_output_.clear();
    dense_output_.add(state.t, state.y);
    gather(state.y, view(d_.get()));
  }
  double integrand(const State& at) const {
    return settings_.integrand({at.t, at.y, at.ydot, nullptr, from_});
  }

  /// The integral over the step, and what it leaves for the next if its size is fixed: its error.
  /// Both by the weights of the table.
  double sum_up(const State& start, double h) {
    // Stages of so short a step differ by rounding; its error is nothing.
    if (!settings_.integrand && h <= 1e-9 * settings_.step) return 0;
    const std::size_t second = evaluated_.second_stage(start.t, h);
    double integral = settings_.integrand ? table_.b[0] * integrand(start) : 0;
    std::vector<double> error(norm_.components().size());
    gather(start.ydot, error);
    for (double& e : error) e *= h * (table_.b[0] - table_.b_embedded[0]);
    for (int i = 1; i < table_.stages(); ++i) {
      const Evaluated& stage = evaluated_[second + static_cast<std::size_t>(i) - 1];
      integral += table_.b[i] * stage.integrand;
      for (std::size_t k = 0; k < error.size(); ++k)
        error[k] += h * (table_.b[i] - table_.b_embedded[i]) * stage.rates[k];
    }
    expected_error_.learn(h, norm_(error, whole_.y));
    if (!fixed()) keep_stable(error);
    return h * integral;
  }

  /// Where the fastest mode limits the steps, the embedded solution differs along it.
  void keep_stable(std::span<const double> error) {
    constexpr double least = 0.01;  // of the tolerated error
    const double size = norm_(error, whole_.y);
    if (size > least) try {
        std::vector<double> d(error.size());
        gather(whole_.y, d);
        for (std::size_t k = 0; k < d.size(); ++k) d[k] -= error[k];
        const State embedded = consistent(whole_.t, d);
        if (jumps_between(system_, whole_, embedded, false).functions.empty())
          stability_.learn(norm_.distance(embedded.ydot, whole_.ydot, whole_.y) / size);
      } catch (const RecoverableError&) {
      }
    limit_steps();
  }
  void limit_steps() {
    double longest = stability_.longest_step();
    if (settings_.max_step > 0) longest = std::min(longest, settings_.max_step);
    if (std::isfinite(longest)) check(ARKodeSetMaxStep(erk_.get(), longest), "ARKodeSetMaxStep");
  }

  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ButcherTable table_;
  ErrorNorm norm_;
  ExpectedError expected_error_;
  AlgebraicSolver algebraic_;
  StabilityLimit stability_;
  EvaluatedStages evaluated_;
  State whole_;                     // consistent state of the last evaluation
  DenseOutput dense_output_;        // through evaluations, gives the guess for the next
  std::vector<double> remembered_;  // Structure::remembered at the start of the step
  double from_ = 0;                 // start of the step, on whose side of a jump its stages lie
  double proposal_;                 // size of the next attempt; 0 before the first adaptive step
  double step_ = 0;                 // size of this attempt, or more
  bool is_behind_jump_ = false;     // since the last step, which has ended at it
  long rejected_ = 0;
  Guard guard_;
  // Destroyed in reverse: ERKStep before what it refers to, the context last.
  Context context_;
  StepControl step_control_;
  VectorOwner d_;  // the differential components
  Owner<void, ARKodeFree> erk_;
};

}  // namespace

std::unique_ptr<Stepper> make_erk(const System& system, const IntegratorSettings& settings,
                                  Counters& counters, const ButcherTable& table) {
  if (!is_explicit(checked_table(table)) || table.embedded_order == 0)
    throw RegistrationError(fmt::format(
        "the Runge-Kutta table \"{}\": expected an explicit one with an embedded method",
        table.name));
  return std::make_unique<ErkSolver>(system, settings, counters, table);
}

}  // namespace gnomon
