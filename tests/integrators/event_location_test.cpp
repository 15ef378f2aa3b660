// Event location on a system whose switching times are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/integrators/stepper.hpp>
#include <numbers>

#include "support/problem_run.hpp"
#include "support/switching_ode.hpp"

namespace gnomon::event_location_test {
namespace {

using namespace testing;

/// A method without error: the motion x(t) by its formula. Its dense output is a straight line, so
/// that the event has to be searched.
class ExactPath : public OneStepMethod {
public:
  explicit ExactPath(std::function<double(double, const ActiveSet*)> x) : x_(std::move(x)) {}
  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override {
    ++attempts;
    if (h < fails_below) return {.reason = "too short"};
    to = from;
    to.t = from.t + h;
    to.y[0] = x_(to.t, options.branch);
    from_ = from, to_ = to;
    return {.success = true};
  }
  void accept(const State&, bool) override {}
  void interpolate(double t, std::span<double> y) const override {
    const double part = (t - from_.t) / (to_.t - from_.t);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = (1 - part) * from_.y[i] + part * to_.y[i];
  }

  int attempts = 0;
  double fails_below = 0;

private:
  std::function<double(double, const ActiveSet*)> x_;
  State from_, to_;
};

/// A step along x(t) on the branch of its start.
struct Step {
  SprungPoints system;
  ExactPath method;
  EventLocator locator;
  State from, to;

  Step(const std::vector<double>& borders, std::function<double(double)> x, double t = 0)
      : Step(
            borders, [x](double at, const ActiveSet*) { return x(at); }, t) {}
  Step(const std::vector<double>& borders, std::function<double(double, const ActiveSet*)> x,
       double t)
      : system({.borders = borders, .x = x(t, nullptr)}), method(x), locator(system, method) {
    from = system.start();
    from.t = t;
    locator.begin(from);
  }
  /// Takes the whole step and, if it left the branch, the landing.
  std::optional<Landing> take(double h) {
    const ActiveSet branch = locator.branch();
    EXPECT_TRUE(method.attempt(from, h, {.branch = &branch}, to).success);
    method.attempts = 0;
    if (!locator.left(to)) return std::nullopt;
    return locator.land(from, h, to);
  }
  void go_on() { from = to; }
};

double sine(double t) {
  return std::sin(t);
}
double time_of(double x) {
  return std::asin(x);
}

TEST(EventLocation, LandsOnTheEventAndSwitchesItsNode) {
  Step step({0.5, 2.0}, sine);
  const auto landing = step.take(1.5);
  ASSERT_TRUE(landing);
  ASSERT_TRUE(landing->attempt.success) << landing->attempt.reason;
  EXPECT_FALSE(landing->at_start);
  EXPECT_NEAR(landing->h, time_of(0.5), 1.5 * EventLocator::tolerance);
  EXPECT_EQ(step.to.t, landing->h);
  EXPECT_EQ(landing->switched, 1);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{1, 0}));
  EXPECT_LE(step.method.attempts, 6);
}

TEST(EventLocation, LeavesNoStepAlone) {
  Step step({0.5}, sine);
  EXPECT_FALSE(step.take(0.5));  // sin 0.5 < 0.5
  EXPECT_EQ(step.locator.branch(), (ActiveSet{0}));
}

TEST(EventLocation, TakesTheEventsOfOneStepInTheirOrder) {
  Step step({0.7, 0.3, 0.5}, sine);
  const std::vector<std::pair<double, ActiveSet>> expected = {
      {0.3, {0, 1, 0}}, {0.5, {0, 1, 1}}, {0.7, {1, 1, 1}}};
  for (const auto& [border, branch] : expected) {
    const auto landing = step.take(1.2 - step.from.t);
    ASSERT_TRUE(landing && landing->attempt.success);
    EXPECT_NEAR(step.to.t, time_of(border), 1.2 * EventLocator::tolerance);
    EXPECT_EQ(landing->switched, 1);
    EXPECT_EQ(step.locator.branch(), branch);
    step.go_on();
  }
  EXPECT_FALSE(
      step.take(1.2 - step.from.t));  // no event is left, and none is repeated because of rounding
}

TEST(EventLocation, SwitchesNodesTogetherThatCannotBeToldApart) {
  for (const auto& [apart, together] :
       {std::pair(0.0, 2), std::pair(1e-8, 2), std::pair(1e-5, 1)}) {
    SCOPED_TRACE(apart);
    Step step({0.5 + apart, 0.5}, sine);
    const auto landing = step.take(1);
    ASSERT_TRUE(landing && landing->attempt.success);
    EXPECT_EQ(landing->switched, together);
    EXPECT_NEAR(landing->h, time_of(0.5), 4 * EventLocator::tolerance);
  }
}

TEST(EventLocation, FindsTheLossOfContact) {
  Step step({0.5}, sine, 1.0);
  ASSERT_EQ(step.locator.branch(), (ActiveSet{1}));
  const auto landing = step.take(2);
  ASSERT_TRUE(landing && landing->attempt.success);
  EXPECT_NEAR(step.to.t, std::numbers::pi - time_of(0.5), 2 * EventLocator::tolerance);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{0}));
}

// Contact that lasts 2.8e-3 at the crest: it is found if a step ends in it, even if the crossing is
// flat.
TEST(EventLocation, FindsTheFirstTouchOfAGrazingContact) {
  const double border = 1 - 1e-6;
  Step step({border}, sine);
  const auto landing = step.take(std::numbers::pi / 2);
  ASSERT_TRUE(landing && landing->attempt.success);
  EXPECT_NEAR(landing->h, time_of(border), 2 * EventLocator::tolerance);
  EXPECT_EQ(landing->switched, 1);
  Step beyond({border}, sine);
  EXPECT_FALSE(beyond.take(2));  // over it
}

TEST(EventLocation, SwitchesAtTheStartWhatSwitchesAMomentLater) {
  Step step({1e-4, 0.5}, sine);  // a thousandth of the step is a moment
  const auto landing = step.take(1);
  ASSERT_TRUE(landing);
  EXPECT_TRUE(landing->at_start);
  EXPECT_EQ(landing->switched, 1);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{1, 0}));
  const auto next = step.take(1);  // the same step again
  ASSERT_TRUE(next && next->attempt.success);
  EXPECT_FALSE(next->at_start);
  EXPECT_NEAR(next->h, time_of(0.5), EventLocator::tolerance);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{1, 1}));
}

TEST(EventLocation, SwitchesAtTheStartWhatIsOffTheBranchThere) {
  Step step({0.2, 0.9}, sine, 0.5);  // in contact with the first
  step.locator.begin(SprungPoints({.borders = {0.2, 0.9}}).start());
  ASSERT_EQ(step.locator.branch(), (ActiveSet{0, 0}));
  const auto landing = step.take(0.1);
  ASSERT_TRUE(landing);
  EXPECT_TRUE(landing->at_start);
  EXPECT_EQ(landing->switched, 1);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{1, 0}));
}

/// At an event, but on the wrong side because of rounding: 1e-9 before the border.
struct JustSwitched : Step {
  JustSwitched() : Step({0.5, 0.8}, sine) {
    EXPECT_TRUE(take(1));
    go_on();
    from.y[0] = 0.5 - 1e-9;
  }
};

TEST(EventLocation, DoesNotSwitchANodeBackByRounding) {
  JustSwitched step;
  const auto landing = step.take(1.2 - step.from.t);
  ASSERT_TRUE(landing && landing->attempt.success);
  EXPECT_FALSE(landing->at_start);
  EXPECT_NEAR(step.to.t, time_of(0.8), EventLocator::tolerance);
  EXPECT_EQ(step.locator.branch(), (ActiveSet{1, 1}));
}

// The same from a checkpoint; without the memory the node would be switched back.
TEST(EventLocation, RemembersWhatHasJustSwitched) {
  JustSwitched step;
  std::vector<double> memory = step.locator.memory();
  for (const bool remembers : {true, false}) {
    SCOPED_TRACE(remembers);
    if (!remembers) memory.front() = -1;  // the time of the event
    Step resumed({0.5, 0.8}, sine);
    resumed.from = step.from;
    Unpacker numbers(memory);
    resumed.locator.restore(numbers);
    EXPECT_EQ(resumed.locator.branch(), (ActiveSet{1, 0}));
    const auto landing = resumed.take(1.2 - resumed.from.t);
    ASSERT_TRUE(landing);
    EXPECT_EQ(landing->at_start, !remembers);
    EXPECT_EQ(resumed.locator.branch(), remembers ? (ActiveSet{1, 1}) : (ActiveSet{0, 0}));
  }
}

TEST(EventLocation, FailsWhereTheMethodDoes) {
  Step step({0.5}, sine);
  const ActiveSet branch = step.locator.branch();
  ASSERT_TRUE(step.method.attempt(step.from, 1, {.branch = &branch}, step.to).success);
  step.method.fails_below = 0.9;
  const Landing landing = step.locator.land(step.from, 1, step.to);
  EXPECT_FALSE(landing.attempt.success);
  EXPECT_EQ(landing.attempt.reason, "too short");
}

// No polynomial finds the zero of a jump, and bisection is slow.
TEST(EventLocation, GivesUpOnAJump) {
  Step step({0.5}, [](double t) { return t < 0.123 ? 0.0 : 100.0; });
  const auto landing = step.take(1);
  ASSERT_TRUE(landing);
  EXPECT_FALSE(landing->attempt.success);  // not to 1e-7 in sixteen attempts: the step is shortened
  EXPECT_EQ(landing->attempt.reason, "an event in the step was not found");
  EXPECT_EQ(step.method.attempts, 16);
}

// ---- by a stepper

struct Stepped {
  Counters counters;
  std::vector<State> states;
  std::vector<StepReport> reports;
};

Stepped run(const SprungPoints& system, const std::string& integrator, double step, double end,
            bool locate) {
  Stepped run;
  IntegratorSettings settings;
  settings.step = step;
  settings.rtol = settings.atol = 1e-6;
  settings.scale = 1;
  settings.end = end;
  settings.locate_events = locate;
  const auto stepper =
      Integrators::find(integrator, "integrator").make(system, settings, run.counters);
  State state = system.start();
  while (state.t < end) {
    run.reports.push_back(stepper->advance(state, end));
    run.states.push_back(state);
  }
  return run;
}

TEST(LocatedEvents, AreWhereTheyAreKnownToBe) {
  const SprungPoints system({.borders = {0.31, 0.52, 0.52, 1.17}, .wear = 2});
  for (const char* integrator : {"esdirk-4", "esdirk-3", "theta", "bdf"}) {
    SCOPED_TRACE(integrator);
    const Stepped located =
        run(system, integrator, integrator == std::string("bdf") ? 0 : 0.1, 1.5, true);
    std::vector<double> times;
    std::vector<int> switched;
    for (std::size_t k = 0; k < located.reports.size(); ++k)
      if (located.reports[k].switched > 0) {
        times.push_back(located.states[k].t);
        switched.push_back(located.reports[k].switched);
      }
    EXPECT_THAT(switched, ::testing::ElementsAre(1, 2, 1));
    ASSERT_EQ(times.size(), 3u);
    EXPECT_NEAR(times[0], 0.31, 2e-8);
    EXPECT_NEAR(times[1], 0.52, 2e-8);
    EXPECT_NEAR(times[2], 1.17, 2e-8);
    EXPECT_EQ(located.counters.events, 3);
  }
}

TEST(LocatedEvents, BringBackTheOrderOfAKnownSolution) {
  const SprungPoints system({.borders = {0.313}, .wear = 2});
  const auto error = [&](double step, bool locate) {
    const State end = run(system, "esdirk-4", step, 1, locate).states.back();
    return std::abs(end.y[SprungPoints::depth(0)] - system.exact_depth(0, 1));
  };
  EXPECT_NEAR(std::log2(error(0.1, true) / error(0.05, true)), 4, 0.7);
  EXPECT_LT(error(0.05, true), 0.05 * error(0.05, false));
}

}  // namespace
}  // namespace gnomon::event_location_test
