#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <utility>

namespace gnomon {

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

/// A step of about h that does not pass the next point to land on.
OneStepStepper::Plan OneStepStepper::plan(const State& state, double t_stop, double h) const {
  double target = end_of_smooth_part(system_.structure(), state.t, t_stop);
  if (fixed())
    target = end_of_fixed_step(state.t, settings_.step, target);
  else if (settings_.max_step > 0)
    h = std::min(h, settings_.max_step);
  const double left = target - state.t;
  if (h >= left * (1 - (fixed() ? sliver : 1e-9))) return {left, target, true};
  // Two equal steps rather than a long one and a sliver.
  if (!fixed() && h > left / 2) h = left / 2;
  return {h, target, false};
}

/// One attempt, ended on the first event when these are located.
Landing OneStepStepper::take(const State& state, const Plan& plan, bool continuation) {
  constexpr int most_switches = 8;  // at the start, one after the other
  AttemptOptions options{.piece = locator_ ? &locator_->piece() : nullptr,
                         .continuation = continuation};
  int switched = 0;
  for (int k = 0; k < most_switches; ++k) {
    next_.piece = locator_ ? locator_->piece() : ActiveSet{};
    Landing whole{.attempt = method_->attempt(state, plan.h, options, next_), .h = plan.h};
    whole.switched = switched;
    const bool acceptable = whole.attempt.success && (fixed() || whole.attempt.error <= 1);
    if (!locator_ || !acceptable || !locator_->left(next_)) return whole;
    Landing landing = locator_->land(state, plan.h, next_);
    if (!landing.grazing) {
      landing.attempt.error = whole.attempt.error;  // of the size that the control asked for
      return landing;
    }
    if (landing.switched == 0) break;
    switched += landing.switched;
  }
  return step_over(state, plan, options);
}

/// Over a kink at the start that cannot be ended on, on whatever pieces there are.
Landing OneStepStepper::step_over(const State& state, const Plan& plan, AttemptOptions options) {
  options.piece = nullptr;
  Landing whole{
      .attempt = method_->attempt(state, plan.h, options, next_), .grazing = true, .h = plan.h};
  next_.piece.clear();
  if (whole.attempt.success) locator_->begin(next_);
  return whole;
}

double OneStepStepper::after_success(const Plan& plan, const Landing& landing) {
  if (fixed()) return std::min(settings_.step, std::max(proposal_, 2 * landing.h));
  const double next = control_.after_success(plan.h, landing.attempt.error);
  // A step cut short by a point to land on says little about longer ones.
  return plan.h < proposal_ ? std::max(next, proposal_) : next;
}

StepReport OneStepStepper::advance(State& state, double t_stop) {
  constexpr int plain_attempts = 8, most_failures = 16;
  if (!begun_) begin(state);
  const long newton_before = counters_.newton_iterations;
  const double shortest = 1e-14 * settings_.end;
  const double wanted = proposal_;
  double tried = proposal_;
  StepReport report;
  std::string reason = "the error test fails";
  const auto newton_iterations = [&] { return counters_.newton_iterations - newton_before; };
  for (int failures = 0; failures < most_failures && proposal_ > shortest &&
                         newton_iterations() < most_newton_iterations;) {
    const Plan plan = this->plan(state, t_stop, proposal_);
    tried = std::min(tried, plan.h);
    const Landing landing = take(state, plan, failures >= plain_attempts);
    if (landing.attempt.success && (fixed() || landing.attempt.error <= 1)) {
      proposal_ = after_success(plan, landing);
      std::swap(state, next_);
      if (landing.h == plan.h && plan.lands) state.t = plan.target;
      method_->accept(state, landing.switched > 0 || landing.grazing ||
                                 is_corner(system_.structure(), state.t));
      ++counters_.steps;
      counters_.events += landing.switched > 0;
      report.step = landing.h;
      report.order = order_;
      report.switched = landing.switched;
      report.newton_iterations = newton_iterations();
      return report;
    }
    report.restarted = true;
    ++counters_.rejected_steps;
    if (landing.attempt.success) {
      proposal_ = control_.after_rejection(plan.h, landing.attempt.error);
      continue;
    }
    reason = landing.attempt.reason;
    proposal_ = control_.after_failure(plan.h);
    if (++failures == plain_attempts) proposal_ = wanted;
  }
  throw SolutionError(fmt::format(
      "no step from t = {:.6g} s succeeds, down to {:.3g} s and after {} Newton iterations: {}",
      state.t, tried, newton_iterations(), reason));
}

void set_rates(const System& system, const ActiveSet* piece, State& state) {
  std::vector<double> F(state.y.size());
  state.ydot.assign(state.y.size(), 0.0);
  system.residual({state.t, state.y, state.ydot, piece}, F);
  const std::vector<char>& differential = system.structure().differential;
  for (std::size_t i = 0; i < F.size(); ++i)
    if (differential[i]) state.ydot[i] = -F[i];
}

}  // namespace gnomon
