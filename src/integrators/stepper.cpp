#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/step_account.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/integrators/stop_rules.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <utility>

namespace gnomon {

namespace {

/// How often a step is tried whose equations cannot be solved. (A rejection by the error test is
/// not a failure: the size of the next attempt follows from the estimate.) The first eight attempts
/// are plain, each half as long as the last, down to 1/256: if the solution is smooth, one of these
/// is short enough. Then follow eight attempts by continuation in the step, beginning with the
/// wanted size, for failures that do not depend on the size: a body that an iterate inverts, an
/// active set that cycles. Two more limits may end this earlier: most_newton_iterations and
/// shortest_step.
class Patience {
public:
  Patience(const StepAccount& account, double wanted, double shortest)
      : account_(account), wanted_(wanted), shortest_(shortest) {}

  /// May a step of this size be tried?
  bool allows(double h) const {
    return failures_ < plain_attempts + continued_attempts && h > shortest_ &&
           account_.newton_iterations() < most_newton_iterations;
  }
  bool by_continuation() const { return failures_ >= plain_attempts; }
  /// After a failure: the size to try next, where half the last one is `halved`.
  double after_failure(double halved) { return ++failures_ == plain_attempts ? wanted_ : halved; }

private:
  static constexpr int plain_attempts = 8, continued_attempts = 8;
  const StepAccount& account_;
  double wanted_, shortest_;
  int failures_ = 0;
};

}  // namespace

OneStepStepper::OneStepStepper(const System& system, const IntegratorSettings& settings,
                               Counters& counters, std::unique_ptr<OneStepMethod> method, int order,
                               int error_order)
    : system_(system),
      settings_(settings),
      counters_(counters),
      method_(std::move(method)),
      order_(order),
      control_(error_order),
      error_order_(error_order) {
  if (settings.locate_events) locator_.emplace(system, *method_);
}

void OneStepStepper::begin(const State& state) {
  begun_ = true;
  proposal_ =
      fixed() ? settings_.step : first_step(state, system_.structure(), settings_, error_order_);
  method_->accept(state, true);
  if (locator_) locator_->begin(state);
}

std::vector<double> OneStepStepper::memory() const {
  std::vector<double> memory = {proposal_};
  pack(memory, control_.memory());
  if (locator_) pack(memory, locator_->memory());
  pack(memory, method_->memory());
  return memory;
}

void OneStepStepper::restore(const State& state, std::span<const double> memory) {
  begin(state);
  Unpacker numbers(memory);
  const double proposal = numbers.one();
  proposal_ = fixed() ? std::min(proposal, settings_.step) : proposal;
  control_.restore(numbers);
  if (locator_) locator_->restore(numbers);
  method_->restore(numbers.rest());
}

/// A step of about h that does not pass the next time at which a step has to end.
OneStepStepper::Plan OneStepStepper::plan(const State& state, double t_stop, double h) const {
  // An adaptive step that misses the target by rounding has to end on it; fixed steps follow their
  // grid, and their remainder must not be too short.
  const double shortfall = fixed() ? shortest_remainder : 1e-9;
  double target = t_stop;
  if (fixed())
    target = end_of_fixed_step(state.t, settings_.step, target);
  else if (settings_.max_step > 0)
    h = std::min(h, settings_.max_step);
  const double left = target - state.t;
  if (h >= left * (1 - shortfall)) return {left, target, true};
  // Two equal steps are better than a long and a very short one.
  if (!fixed() && h > left / 2) h = left / 2;
  return {h, target, false};
}

bool OneStepStepper::acceptable(const Attempt& attempt) const {
  return attempt.success && (fixed() || attempt.error <= 1);
}

/// One attempt, which ends on the first event if events are located.
Landing OneStepStepper::take(const State& state, const Plan& plan, AttemptOptions options) {
  // Groups of nodes may switch at the start, one after the other. A node switches there at most
  // once, so this loop ends; after eight attempts without a step it costs less to step over the
  // rest.
  constexpr int most_switches = 8;
  int switched = 0;
  for (int k = 0; k < most_switches; ++k) {
    next_.branch = locator_ ? locator_->branch() : ActiveSet{};
    const ActiveSet branch = next_.branch;
    options.branch = locator_ ? &branch : nullptr;
    Landing whole{.attempt = method_->attempt(state, plan.h, options, next_), .h = plan.h};
    whole.switched = switched;
    if (!locator_ || !acceptable(whole.attempt) || !locator_->left(next_)) return whole;
    Landing landing = locator_->land(state, plan.h, next_);
    if (!landing.at_start) {
      landing.attempt.error = whole.attempt.error;  // error of the step size that the control chose
      return landing;
    }
    if (landing.switched == 0) break;
    switched += landing.switched;
  }
  options.branch = nullptr;
  return step_over(state, plan, options);
}

/// Steps over a kink at the start on which no step can end; the signs choose the branches.
Landing OneStepStepper::step_over(const State& state, const Plan& plan,
                                  const AttemptOptions& options) {
  Landing whole{
      .attempt = method_->attempt(state, plan.h, options, next_), .at_start = true, .h = plan.h};
  next_.branch.clear();
  if (whole.attempt.success) locator_->begin(next_);
  return whole;
}

double OneStepStepper::after_success(const Plan& plan, const Landing& landing) {
  if (fixed()) return std::min(settings_.step, std::max(proposal_, 2 * landing.h));
  const double next = control_.after_success(plan.h, landing.attempt.error);
  // A step that was shortened to end at a given time says little about longer ones.
  return plan.h < proposal_ ? std::max(next, proposal_) : next;
}

/// next_ becomes the state.
void OneStepStepper::accept(State& state, const Plan& plan, const Landing& landing) {
  std::swap(state, next_);
  if (landing.h == plan.h && plan.lands) state.t = plan.target;  // without the rounding of t + h
  const bool kink =
      landing.switched > 0 || landing.at_start || is_breakpoint(system_.structure(), state.t);
  if (kink) begin_behind_kink(state, landing);
  method_->accept(state, kink);
  counters_.events += landing.switched > 0;
}

/// A rate may jump at a kink: the next step begins with that behind it.
void OneStepStepper::begin_behind_kink(State& state, const Landing& landing) const {
  const ActiveSet branch = locator_ ? locator_->branch() : ActiveSet{};
  const bool located = locator_ && !landing.at_start;
  set_rates_behind_jump(system_, located ? &branch : state.own_branch(), state);
}

StepReport OneStepStepper::report(const Landing& landing, int order, StepAccount& account) const {
  StepReport report = account.accept(landing.h, order);
  report.switched = landing.switched;
  report.integral = landing.attempt.integral;
  return report;
}

/// One short step, which leaves the step size control as it is. Returns false if it fails.
bool OneStepStepper::settle(State& state, double t_end, StepAccount& account, StepReport& report) {
  const Plan plan{t_end - state.t, t_end, true};
  const Landing landing = take(state, plan, {.settles = true});
  if (!landing.attempt.success) {
    account.reject();
    return false;
  }
  accept(state, plan, landing);
  report = this->report(landing, 1, account);
  return true;
}

StepReport OneStepStepper::advance(State& state, double t_stop) {
  if (!begun_) begin(state);
  StepAccount account(counters_);
  const SettlingStop stop = settling_stop(settings_, state.t, t_stop);
  t_stop = end_of_smooth_part(system_.structure(), state.t, stop.t);
  if (StepReport report; stop.settles && settle(state, t_stop, account, report)) return report;
  Patience patience(account, proposal_, shortest_step(settings_));
  double shortest_tried = proposal_;
  std::string reason = "the error test fails";
  while (patience.allows(proposal_)) {
    const Plan plan = this->plan(state, t_stop, proposal_);
    shortest_tried = std::min(shortest_tried, plan.h);
    const Landing landing = take(state, plan, {.continuation = patience.by_continuation()});
    if (acceptable(landing.attempt)) {
      proposal_ = after_success(plan, landing);
      accept(state, plan, landing);
      return report(landing, order_, account);
    }
    account.reject();
    if (landing.attempt.success) {
      proposal_ = control_.after_rejection(plan.h, landing.attempt.error);
    } else {
      reason = landing.attempt.reason;
      proposal_ = patience.after_failure(control_.after_failure(plan.h));
    }
  }
  throw SolutionError(fmt::format(
      "no step from t = {:.6g} s succeeds, down to {:.3g} s and after {} Newton iterations: {}",
      state.t, shortest_tried, account.newton_iterations(), reason));
}

}  // namespace gnomon
