#include "run/bounded_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/model/observation.hpp>
#include <gnomon/newton/interruption.hpp>

#include "run/guards.hpp"
#include "run/store_schedule.hpp"

namespace gnomon {

SolutionError at_limit(double t, const Limit& limit) {
  return SolutionError(fmt::format("from t = {:.6g} s on {}", t, limit.reason));
}

IntegratorSettings BoundedSteps::settings() const {
  IntegratorSettings settings = settings_;
  std::vector<double>& settled = settings.settled;
  if (early_end_ < never && !settled.empty())
    settled.insert(std::ranges::lower_bound(settled, early_end_), early_end_);
  return settings;
}

void BoundedSteps::begin() {
  stepper_ = integrator_.make(model().system(), settings(), counters_);
  if (counters_.steps > 0) stepper_->restore(state(), memory_.stepper);
}

bool BoundedSteps::follow(bool same_unknowns) {
  if (!stepper_) return true;  // at the start
  auto next = integrator_.make(model().system(), settings(), counters_);
  const bool goes_on = next->follow(*stepper_, state(), same_unknowns);
  stepper_ = std::move(next);
  return goes_on;
}

BoundedStep BoundedSteps::advance(double stop, const std::function<bool()>& interrupted) {
  if (!stepper_) begin();
  BoundedStep step{.before = state(), .report = {}, .observed = {}, .limit = {}};
  remember();
  if (state().t >= early_end_) early_end_ = never;
  try {
    const Interruptible here(interrupted);
    step.report = stepper_->advance(state(), std::min(stop, early_end_));
  } catch (const Interruption&) {
    state() = step.before;
    throw;
  }
  step.observed = observe(step.report);
  if (model().overdue) come_near(step);
  if (model().limit) stop_short(step);
  stop_before(
      {"thickness_left", 0, "a body is worn through: wear takes all its thickness at a node"},
      step);
  stop_before({"element_volume", least_element_volume, worn_away_text(least_element_volume)}, step);
  if (until_) end_early(step);
  return step;
}

Observation BoundedSteps::observe(const StepReport& report) const {
  Observation observed = model().observe(memory_.state);
  if (settings_.integrand) {  // where earlier versions have the column
    const double before = value_of(last_, "wear_integral").value_or(0);
    observed.insert(std::ranges::find(observed, "wear_depth", &Scalar::name),
                    common("wear_integral", before + report.integral, dimension_of(observed)));
  }
  return observed;
}

void BoundedSteps::repeat(BoundedStep& step, double end) {
  --counters_.steps;
  ++counters_.rejected_steps;
  state() = step.before;
  begin();
  step.report = stepper_->advance(state(), end);
  step.observed = observe(step.report);
}

/// Halves a step that goes beyond where another model should have followed.
void BoundedSteps::come_near(BoundedStep& step) {
  constexpr int most = 20;  // where boundary is inside from the start
  for (int i = 0; i < most && model().overdue(state()); ++i) repeat_half(step);
}

/// Halves a step that has passed a limit of the model. Throws SolutionError where that is of no
/// use.
void BoundedSteps::stop_short(BoundedStep& step) {
  constexpr int most = 20;
  step.limit = model().limit(state());
  for (int i = 0; i < most && step.limit && step.limit->passed; ++i) {
    repeat_half(step);
    step.limit = model().limit(state());
  }
  if (!step.limit || !step.limit->passed) return;
  state() = step.before;
  throw at_limit(state().t, *step.limit);
}

/// Repeats a step that wears off what is left, of a body or of an element, with an end shortly
/// before.
void BoundedSteps::stop_before(const WornOff& what, BoundedStep& step) {
  constexpr int most = 20;
  constexpr double shortly = 0.998, thin = 0.01;  // parts of the step, and of what was there
  const auto above = [&](const Observation& observed) {
    return value_of(observed, what.left).value_or(1) - what.least;
  };
  const double before = above(last_);
  if (above(step.observed) > 0 || before <= 0) return;
  for (int i = 0; i < most && above(step.observed) <= 0; ++i) {
    const double part = before / (before - above(step.observed));
    repeat(step, step.before.t + shortly * part * (state().t - step.before.t));
  }
  step.limit = model().limit ? model().limit(state()) : std::nullopt;  // of the shorter step
  if (above(step.observed) > 0 && above(step.observed) < thin) step.limit = {what.reason};
}

/// Repeats a step that goes beyond time.until, with an end there. A method of several steps begins
/// again with small ones, and goes on to that end.
void BoundedSteps::end_early(BoundedStep& step) {
  constexpr int most = 10;  // where an observation jumps
  for (int i = 0; i < most; ++i) {
    const double after = excess(*until_, step.observed), size = state().t - step.before.t;
    early_step_ = std::max(early_step_, size);
    const double part =
        after >= 0 ? part_until(excess(*until_, last_), after, early_step_ / size) : 1;
    if (part >= 1) break;
    early_end_ = step.before.t + part * size;
    repeat(step, early_end_);
    step.limit = model().limit ? model().limit(state()) : std::nullopt;  // of the shorter step
  }
}

}  // namespace gnomon
