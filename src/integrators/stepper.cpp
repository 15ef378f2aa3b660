#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/stepper.hpp>
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
  Patience(double wanted, double shortest) : wanted_(wanted), shortest_(shortest) {}

  /// May a step of this size be tried after so many iterations of this step?
  bool allows(double h, long newton_iterations) const {
    return failures_ < plain_attempts + continued_attempts && h > shortest_ &&
           newton_iterations < most_newton_iterations;
  }
  bool by_continuation() const { return failures_ >= plain_attempts; }
  /// After a failure: the size to try next, where half the last one is `halved`.
  double after_failure(double halved) { return ++failures_ == plain_attempts ? wanted_ : halved; }

private:
  static constexpr int plain_attempts = 8, continued_attempts = 8;
  double wanted_, shortest_;
  int failures_ = 0;
};

}  // namespace

OneStepStepper::OneStepStepper(const System& system, const IntegratorSettings& settings,
                               Counters& counters, std::unique_ptr<OneStepMethod> method, int order,
                               int error_order)
    : Stepper(counters),
      system_(system),
      settings_(settings),
      counters_(counters),
      norm_(system.structure(), settings),
      method_(std::move(method)),
      order_(order),
      control_(error_order),
      error_order_(error_order),
      expected_error_(settings, order, error_order) {
  // How long a method that damps stiff components needs to damp a closing.
  constexpr int steps_to_damp = 2;
  if (settings.locate_events) locator_.emplace(system, *method_);
  if (!settings.settled.empty()) closings_.emplace(steps_to_damp);
}

void OneStepStepper::begin(const State& state) {
  begun_ = true;
  proposal_ =
      fixed() ? settings_.step : first_step(state, system_.structure(), settings_, error_order_);
  method_->accept(state, true);
  if (locator_) locator_->begin(state);
  if (closings_) closings_->begin(active(state));
}

std::vector<double> OneStepStepper::memory() const {
  std::vector<double> memory = {proposal_, closings_ ? closings_->memory() : 0};
  pack(memory, control_.memory());
  if (locator_) pack(memory, locator_->memory());
  pack(memory, method_->memory());
  return memory;
}

void OneStepStepper::restore(const State& state, std::span<const double> memory) {
  begin(state);
  Unpacker numbers(memory);
  const double proposal = numbers.one(), since_closing = numbers.one();
  proposal_ = fixed() ? std::min(proposal, settings_.step) : proposal;
  control_.restore(numbers);
  if (locator_) locator_->restore(numbers);
  if (closings_) {
    closings_->begin(active(state));
    closings_->restore(since_closing);
  }
  method_->restore(numbers.rest());
}

/// Other unknowns: the size of steps and the history of their errors remain.
bool OneStepStepper::follow(Stepper& before, const State& state, bool same) {
  const auto& earlier = dynamic_cast<const OneStepStepper&>(before);
  if (!earlier.begun_) return true;
  if (same) {
    restore(state, earlier.memory());
    return true;
  }
  begin(state);
  proposal_ = earlier.proposal_;
  control_ = earlier.control_;
  if (closings_ && earlier.closings_) closings_->restore(earlier.closings_->memory());
  return true;
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
    // Steps that end at events do so at jumps too.
    if (!locator_ && !fixed() && acceptable(whole.attempt)) {
      const JumpError jumps = error_of_jumps(system_, norm_, state, next_, whole.h);
      whole.attempt.error = std::max(whole.attempt.error, jumps.error);
      whole.attempt.shorter = jumps.shorter;
    }
    if (!locator_ || !acceptable(whole.attempt) || !locator_->left(next_)) return whole;
    Landing landing = locator_->land(state, plan.h, next_);
    if (!landing.at_start) {
      landing.attempt.error = whole.attempt.error;  // error of the step size that the control chose
      return landing;
    }
    if (landing.switched == 0) break;
    switched += landing.switched;
  }
  // A kink at the start on which no step can end is stepped over; the signs choose the branches.
  options.branch = nullptr;
  Landing whole{
      .attempt = method_->attempt(state, plan.h, options, next_), .at_start = true, .h = plan.h};
  next_.branch.clear();
  if (whole.attempt.success) locator_->begin(next_);
  return whole;
}

double OneStepStepper::after_success(const Plan& plan, const Landing& landing) {
  expected_error_.learn(plan.h, landing.attempt.error);
  if (fixed()) return std::min(settings_.step, std::max(proposal_, 2 * landing.h));
  const double next = control_.after_success(plan.h, landing.attempt.error);
  // A step that was shortened to end at a given time says little about longer ones.
  return plan.h < proposal_ ? std::max(next, proposal_) : next;
}

/// next_ becomes the state.
void OneStepStepper::accept(State& state, const Step& step) {
  const Landing& landing = step.landing;
  std::swap(state, next_);
  if (step.lands()) state.t = step.plan.target;  // without the rounding of t + h
  const bool kink =
      landing.switched > 0 || landing.at_start || is_breakpoint(system_.structure(), state.t);
  if (kink) begin_behind_kink(state, landing);
  method_->accept(state, kink);
  if (closings_) closings_->accept(active(state), step.settles);
  counters_.events += landing.switched > 0;
}

/// A rate may jump at a kink: the next step begins with that behind it.
void OneStepStepper::begin_behind_kink(State& state, const Landing& landing) {
  const ActiveSet branch = locator_ ? locator_->branch() : ActiveSet{};
  const bool located = locator_ && !landing.at_start;
  const ActiveSet* const own = located ? &branch : state.own_branch();
  if (!is_breakpoint(system_.structure(), state.t)) {
    set_rates_behind_jump(system_, own, state);
  } else if (pass_breakpoint(system_, settings_, counters_, own, state) && locator_ &&
             state.branch.empty()) {
    locator_->begin(state);
  }
}

/// The active set with which a step ends in `state`, events included.
ActiveSet OneStepStepper::active(const State& state) const {
  return locator_ ? locator_->branch() : active_set(system_, state.t, state.y);
}

/// Attempts from `state` until one is acceptable; next_ is then the end of the step.
OneStepStepper::Step OneStepStepper::ordinary_step(const State& state, double t_stop) {
  Patience patience(proposal_, shortest_step(settings_));
  double shortest_tried = proposal_;
  std::string reason = "the error test fails";
  while (patience.allows(proposal_, newton_iterations())) {
    const Plan plan = this->plan(state, t_stop, proposal_);
    shortest_tried = std::min(shortest_tried, plan.h);
    const Landing landing = take(
        state, plan,
        {.continuation = patience.by_continuation(), .error = expected_error_.of_step(plan.h)});
    if (acceptable(landing.attempt)) return {plan, landing};
    ++counters_.rejected_steps;
    if (landing.attempt.success) {
      const double wanted = control_.after_rejection(plan.h, landing.attempt.error);
      proposal_ = landing.attempt.shorter > 0 ? landing.attempt.shorter : wanted;
    } else {
      reason = landing.attempt.reason;
      proposal_ = patience.after_failure(control_.after_failure(plan.h));
    }
  }
  throw SolutionError(fmt::format(
      "no step from t = {:.6g} s succeeds, down to {:.3g} s and after {} Newton iterations: {}",
      state.t, shortest_tried, newton_iterations(), reason));
}

/// The short steps that lead to a settled time, as one step to next_; none if they cannot be
/// accepted.
std::optional<OneStepStepper::Step> OneStepStepper::short_step(const State& state, double t_end) {
  constexpr double tolerated = 0.5;  // its size does not follow from the last error
  const std::optional<EventLocator> before = locator_;
  const Step step{{t_end - state.t, t_end, true}, {}, true};
  // They are for the algebraic components, of which an error of the differential ones sees nothing.
  const Landing landing = take(state, step.plan, {.settles = true});
  const bool whole = landing.attempt.success && landing.h == step.plan.h && landing.switched == 0;
  if (whole && landing.attempt.error <= tolerated) return Step{step.plan, landing, true};
  if (before) locator_.emplace(*before);
  return {};
}

/// Where a node has closed recently, a settled time is reached by short steps; otherwise the
/// damping of the method is enough. An ordinary step to that time in which a node closes is taken
/// back.
OneStepStepper::Step OneStepStepper::next_step(const State& state, double t_stop) {
  std::optional<Settling> settling;
  if (closings_) settling = next_settling(system_.structure(), settings_, state.t);
  if (!settling || settling->end > t_stop) return ordinary_step(state, t_stop);
  if (!settling->before(state.t)) {
    if (const std::optional<Step> step = short_step(state, t_stop)) return *step;
    ++counters_.rejected_steps;
    return ordinary_step(state, settling->shorter(state.t));
  }
  if (!closings_->recent()) {
    const std::optional<EventLocator> before = locator_;
    Step step = ordinary_step(state, t_stop);
    if (!step.lands() || !closings_->closes(active(next_))) return step;
    ++counters_.rejected_steps;
    if (before) locator_.emplace(*before);
  }
  return ordinary_step(state, settling->begin);
}

StepReport OneStepStepper::take_step(State& state, double t_stop) {
  if (!begun_) begin(state);
  newton_before_ = counters_.newton_iterations;
  t_stop = end_of_smooth_part(system_.structure(), state.t, t_stop);
  if (!fixed()) t_stop = end_at_stop(system_.structure(), state.t, t_stop);
  const Step step = next_step(state, t_stop);
  if (!step.settles) proposal_ = after_success(step.plan, step.landing);
  accept(state, step);
  // The rates change quickly behind an event, and the error estimate of a long step, which damps
  // stiff components, does not see it: begin as at the start of a run.
  if (!fixed() && step.landing.switched > 0)
    proposal_ =
        std::min(proposal_, first_step(state, system_.structure(), settings_, error_order_));
  return {.step = step.landing.h,
          .order = step.settles ? 1 : order_,
          .switched = step.landing.switched,
          .integral = step.landing.attempt.integral};
}

}  // namespace gnomon
