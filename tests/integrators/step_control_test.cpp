// The choice of steps: the controller, the times at which steps end, and the treatment of failures;
// with minimal methods.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/dense_output.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/integrators/stop_times.hpp>

#include "support/switching_ode.hpp"

namespace gnomon::step_control_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

// ---- controller

TEST(StepSizeControl, FollowsThePiFormula) {
  StepSizeControl control(3);  // error ~ h^4
  EXPECT_DOUBLE_EQ(control.after_success(2, 0.5), 2 * 0.9 * std::pow(0.5, -0.7 / 4));
  EXPECT_DOUBLE_EQ(control.after_success(2, 0.1),
                   2 * 0.9 * std::pow(0.1, -0.7 / 4) * std::pow(0.5, 0.4 / 4));
  EXPECT_DOUBLE_EQ(control.after_rejection(2, 16), 2 * 0.9 / 2);
}

TEST(StepSizeControl, BoundsGrowthAndShrinking) {
  StepSizeControl control(1);
  EXPECT_DOUBLE_EQ(control.after_success(3, 0), 15);
  EXPECT_DOUBLE_EQ(control.after_success(3, 1e9), 0.6);
  EXPECT_DOUBLE_EQ(control.after_rejection(3, 1e9), 0.6);
  EXPECT_LT(control.after_rejection(3, 1.0001), 2.7);  // at least a tenth shorter
}

TEST(StepSizeControl, DoesNotGrowRightAfterARejectionOrAFailure) {
  StepSizeControl control(1);
  control.after_rejection(1, 2);
  EXPECT_DOUBLE_EQ(control.after_success(1, 1e-4), 1);
  EXPECT_GT(control.after_success(1, 1e-4), 1.5);
  EXPECT_DOUBLE_EQ(control.after_failure(1), 0.5);
  EXPECT_DOUBLE_EQ(control.after_success(0.5, 1e-4), 0.5);
  EXPECT_GT(control.after_success(0.5, 1e-4), 0.75);
}

TEST(StepSizeControl, GoesOnWithItsMemory) {
  StepSizeControl control(2), resumed(2), fresh(2);
  control.after_success(1, 0.01);
  control.after_rejection(1, 2);
  const std::vector<double> memory = control.memory();
  Unpacker numbers(memory);
  resumed.restore(numbers);
  EXPECT_NE(fresh.after_success(1, 0.3), control.after_success(1, 0.3));
  resumed.after_success(1, 0.3);
  EXPECT_EQ(resumed.after_success(1, 0.2), control.after_success(1, 0.2));
}

TEST(FirstStep, MovesTheSurfaceByWhatTheToleranceAllowsOfItsDepth) {
  Structure structure;
  structure.differential = {1, 0, 1};
  State start{.t = 2, .y = {0, 0, 0}, .ydot = {0.5, 100, -4}};
  IntegratorSettings settings;
  settings.rtol = 1e-6;
  settings.scale = 10;
  settings.end = 52;
  EXPECT_DOUBLE_EQ(first_step(start, structure, settings, 2), 0.01 * 10 / 4);
  settings.scale = 1e6;
  EXPECT_DOUBLE_EQ(first_step(start, structure, settings, 2), 50);  // at most to the end
  start.ydot = {0, 100, 0};
  EXPECT_DOUBLE_EQ(first_step(start, structure, settings, 2), 0.5);
}

// ---- points to end on

TEST(StopTimes, OfFixedStepsAreOnTheGridByCount) {
  double t = 0;
  for (int k = 1; k <= 100000; ++k) {
    t = end_of_fixed_step(t, 0.1, 1e9);
    ASSERT_EQ(t, 0.1 * k);  // adding up would be off by 2e-8 at the end
  }
}

TEST(StopTimes, OfFixedStepsLeaveNoShortRemainders) {
  EXPECT_EQ(end_of_fixed_step(0.9, 0.1, 1.00005), 1.00005);  // merged with the grid
  EXPECT_EQ(end_of_fixed_step(0.9, 0.1, 1.0002), 0.1 * 10);
  EXPECT_EQ(end_of_fixed_step(0.9, 0.1, 0.95), 0.95);
  EXPECT_EQ(end_of_fixed_step(0.99995, 0.1, 2), 0.1 * 11);  // too near to the grid for a step
  EXPECT_EQ(end_of_fixed_step(0.9998, 0.1, 2), 0.1 * 10);
}

TEST(StopTimes, AreBreakpointsOfTheLoad) {
  Structure structure;
  structure.breakpoints = {1, 3};
  EXPECT_EQ(end_of_smooth_part(structure, 0, 5), 1);
  EXPECT_EQ(end_of_smooth_part(structure, 1, 5), 3);
  EXPECT_EQ(end_of_smooth_part(structure, 1, 2), 2);
  EXPECT_EQ(end_of_smooth_part(structure, 3, 5), 5);
  EXPECT_TRUE(is_breakpoint(structure, 3));
  EXPECT_FALSE(is_breakpoint(structure, 2));
}

// ---- norm

TEST(ErrorNorm, IsTheRootMeanSquareOverTheDifferentialComponents) {
  Structure structure;
  structure.size = 3;
  structure.differential = {1, 0, 1};
  IntegratorSettings settings;
  settings.rtol = 0.1;
  settings.atol = 0.5;
  const ErrorNorm norm(structure, settings);
  EXPECT_THAT(norm.components(), ::testing::ElementsAre(0, 2));
  const std::vector<double> y = {-5, 1e9, 0};
  EXPECT_DOUBLE_EQ(norm.weight(0, -5), 1);  // 1 / (0.1 * 5 + 0.5)
  EXPECT_DOUBLE_EQ(norm.weight(0, 0), 2);
  EXPECT_DOUBLE_EQ(norm(std::vector<double>{3, 2}, y), std::sqrt((9 + 16) / 2.0));
  structure.tolerance_scale = {1, 1, 4};  // of the absolute part
  EXPECT_DOUBLE_EQ(ErrorNorm(structure, settings)(std::vector<double>{3, 2}, y),
                   std::sqrt((9 + 1) / 2.0));
  settings.rtol = settings.atol = 0;
  EXPECT_DOUBLE_EQ(ErrorNorm(structure, settings)(std::vector<double>{3, 4}, y), std::sqrt(12.5));
}

// ---- dense output

TEST(DenseOutput, ReproducesACubicThroughFourStates) {
  const auto cubic = [](double t) { return 1 - 2 * t + 0.5 * t * t * t; };
  DenseOutput output;
  for (double t : {0.0, 0.4, 0.7, 1.0}) output.add(t, std::vector<double>{cubic(t), t});
  for (double t : {0.2, 0.9, 1.2}) {
    std::vector<double> y(2);
    output.evaluate(t, y);
    EXPECT_NEAR(y[0], cubic(t), 1e-14);
    EXPECT_NEAR(y[1], t, 1e-14);
  }
}

TEST(DenseOutput, TakesTheNearestStates) {
  DenseOutput output;
  for (int k = 0; k <= 10; ++k) output.add(k, std::vector<double>{k < 7 ? 100.0 : double(k)});
  std::vector<double> y(1);
  output.evaluate(8.6, y);  // 7 to 10 are on a line
  EXPECT_NEAR(y[0], 8.6, 1e-13);
}

// Two steps ahead a cubic would magnify errors 49-fold, a parabola 17-fold, a line fivefold.
TEST(DenseOutput, FallsBackToALineFarAhead) {
  DenseOutput output;
  for (int k = 0; k <= 3; ++k) output.add(k, std::vector<double>{double(k * k * k)});
  std::vector<double> y(1);
  output.evaluate(5, y);
  EXPECT_NEAR(y[0], 27 + 2 * (27 - 8), 1e-12);
  output.evaluate(4, y);  // a parabola one step ahead: 8 + 3 (27 - 8 - (8 - 1)) ...
  EXPECT_NEAR(y[0], 3 * 27 - 3 * 8 + 1, 1e-12);
}

TEST(DenseOutput, HoldsOneStatePerTimeAndForgetsTheOldest) {
  DenseOutput output;
  output.add(1, std::vector<double>{5});
  output.add(1, std::vector<double>{7});
  std::vector<double> y(1);
  output.evaluate(3, y);
  EXPECT_EQ(y[0], 7);
  for (int k = 0; k < 14; ++k) output.add(10 + k, std::vector<double>{1});
  output.evaluate(1, y);  // 7 has been dropped
  EXPECT_NEAR(y[0], 1, 1e-12);
  output.clear();
  output.evaluate(1, y);
  EXPECT_EQ(y[0], 0);
}

// ---- stepper

/// Records its calls and returns prescribed results.
class Obedient : public OneStepMethod {
public:
  struct Asked {
    double t, h;
    bool continuation;
  };
  std::vector<Asked> asked;
  std::vector<char> kinks;
  std::function<Attempt(double t, double h, bool continuation)> outcome = [](double, double, bool) {
    return Attempt{.success = true};
  };

  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override {
    asked.push_back({from.t, h, options.continuation});
    to = from;
    to.t = from.t + h;
    return outcome(from.t, h, options.continuation);
  }
  void accept(const State&, bool kink) override { kinks.push_back(kink); }
  void interpolate(double, std::span<double>) const override {}
};

struct Driven {
  SprungPoints system;
  Counters counters;
  Obedient* method;
  std::unique_ptr<OneStepStepper> stepper;
  State state;

  explicit Driven(const IntegratorSettings& settings, const std::vector<double>& breakpoints = {})
      : system({.breakpoints = breakpoints}), state(system.start()) {
    auto owned = std::make_unique<Obedient>();
    method = owned.get();
    stepper = std::make_unique<OneStepStepper>(system, settings, counters, std::move(owned), 2, 1);
  }
};

IntegratorSettings fixed(double step) {
  IntegratorSettings settings;
  settings.step = step;
  settings.end = 100;
  return settings;
}

/// A first step of 1: rate 1, scale 100, part rtol^(1/2).
IntegratorSettings adaptive() {
  IntegratorSettings settings;
  settings.rtol = settings.atol = 1e-4;
  settings.scale = 100;
  settings.end = 100;
  return settings;
}

TEST(OneStepStepper, EndsFixedStepsOnTheGridOnBreakpointsAndOnStops) {
  Driven run(fixed(0.1), {0.25});
  std::vector<double> times;
  while (run.state.t < 0.45) {
    run.stepper->advance(run.state, 0.45);
    times.push_back(run.state.t);
  }
  EXPECT_THAT(times, ::testing::ElementsAre(0.1 * 1, 0.1 * 2, 0.25, 0.1 * 3, 0.1 * 4, 0.45));
  // A breakpoint is a kink; the start is one, too.
  EXPECT_THAT(run.method->kinks, ::testing::ElementsAre(1, 0, 0, 1, 0, 0, 0));
}

TEST(OneStepStepper, EndsChosenStepsOnBreakpointsExactly) {
  Driven run(adaptive(), {2.5});
  run.method->outcome = [](double, double, bool) {
    return Attempt{.success = true, .error = 0.81};
  };
  std::vector<double> times;
  while (run.state.t < 10) {
    const StepReport report = run.stepper->advance(run.state, 10);
    EXPECT_FALSE(report.restarted);
    times.push_back(run.state.t);
  }
  EXPECT_THAT(times, ::testing::Contains(2.5));
  EXPECT_EQ(times.back(), 10);
}

TEST(OneStepStepper, TakesTwoEqualStepsRatherThanALongOneAndASliver) {
  Driven run(adaptive());
  run.stepper->advance(run.state, 1.1);  // would step by 1
  EXPECT_DOUBLE_EQ(run.state.t, 0.55);
  run.stepper->advance(run.state, 1.1);
  EXPECT_EQ(run.state.t, 1.1);
}

TEST(OneStepStepper, ObeysTheLongestStep) {
  IntegratorSettings settings = adaptive();
  settings.max_step = 0.3;
  Driven run(settings);
  for (int k = 0; k < 10; ++k) EXPECT_LE(run.stepper->advance(run.state, 100).step, 0.3);
}

TEST(OneStepStepper, IsNotShortenedForGoodByAPointToEndOn) {
  Driven run(adaptive());
  run.method->outcome = [](double, double h, bool) {
    return Attempt{.success = true, .error = h * h};  // 0.9 of the size is right
  };
  run.stepper->advance(run.state, 1e-3);
  run.stepper->advance(run.state, 100);
  EXPECT_DOUBLE_EQ(run.method->asked.back().h, 1);
}

TEST(OneStepStepper, RepeatsAStepWhoseErrorIsTooLargeByTheFormula) {
  Driven run(adaptive());
  run.method->outcome = [](double, double h, bool) {
    return Attempt{.success = true, .error = 4 * h * h};
  };
  const StepReport report = run.stepper->advance(run.state, 100);
  ASSERT_EQ(run.method->asked.size(), 2u);
  EXPECT_DOUBLE_EQ(run.method->asked[1].h, 0.9 / 2);
  EXPECT_DOUBLE_EQ(report.step, 0.45);
  EXPECT_TRUE(report.restarted);
  EXPECT_EQ(run.counters.rejected_steps, 1);
  EXPECT_EQ(run.counters.steps, 1);
}

// Eight times half as long, then the same by continuation from the wanted size, then the end.
TEST(OneStepStepper, TriesEightPlainStepsAndEightByContinuation) {
  Driven run(fixed(1));
  run.method->outcome = [](double, double, bool) { return Attempt{.reason = "no"}; };
  EXPECT_THAT([&] { run.stepper->advance(run.state, 100); },
              ::testing::ThrowsMessage<SolutionError>(HasSubstr("no step from t = 0 s succeeds, "
                                                                "down to 0.00781 s")));
  ASSERT_EQ(run.method->asked.size(), 16u);
  for (int k = 0; k < 16; ++k) {
    EXPECT_EQ(run.method->asked[k].h, std::ldexp(1, -(k % 8))) << k;
    EXPECT_EQ(run.method->asked[k].continuation, k >= 8) << k;
  }
  EXPECT_EQ(run.counters.rejected_steps, 16);
  EXPECT_EQ(run.counters.steps, 0);
  EXPECT_EQ(run.state.t, 0);
}

TEST(OneStepStepper, CountsFailuresAndNotWhatTheErrorTestRejects) {
  Driven run(adaptive());
  // Rejections by a fifth each, more than the sixteen failures that a step may take.
  int rejected = 0;
  run.method->outcome = [&](double, double h, bool) {
    rejected += h > 2e-12;
    return Attempt{.success = true, .error = h > 2e-12 ? 1e30 : 0.5};
  };
  run.stepper->advance(run.state, 100);
  EXPECT_GT(rejected, 16);
  EXPECT_EQ(run.counters.rejected_steps, rejected);
}

TEST(OneStepStepper, TriesNoStepBelowTheShortest) {
  Driven run(adaptive());
  run.method->outcome = [](double, double, bool) {
    return Attempt{.success = true, .error = 1e30};
  };
  EXPECT_THAT([&] { run.stepper->advance(run.state, 100); },
              ::testing::ThrowsMessage<SolutionError>(HasSubstr("the error test fails")));
  EXPECT_GT(run.method->asked.back().h, shortest_step(adaptive()));
  EXPECT_LT(run.method->asked.back().h, 6 * shortest_step(adaptive()));
}

TEST(OneStepStepper, DoublesFixedStepsBackToTheirSizeAfterAFailure) {
  Driven run(fixed(1));
  run.method->outcome = [](double t, double h, bool) {
    return t == 0 && h > 0.3 ? Attempt{.reason = "no"} : Attempt{.success = true};
  };
  std::vector<double> times;
  for (int k = 0; k < 4; ++k) {
    run.stepper->advance(run.state, 100);
    times.push_back(run.state.t);
  }
  EXPECT_THAT(times, ::testing::ElementsAre(0.25, 0.75, 1, 2));
}

TEST(OneStepStepper, GoesOnWithItsMemoryAsItWould) {
  Driven run(adaptive()), resumed(adaptive());
  const auto outcome = [](double, double h, bool) {
    return Attempt{.success = true, .error = h * h / 4};
  };
  run.method->outcome = resumed.method->outcome = outcome;
  for (int k = 0; k < 3; ++k) run.stepper->advance(run.state, 100);
  resumed.state = run.state;
  resumed.stepper->restore(resumed.state, run.stepper->memory());
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(run.stepper->advance(run.state, 100).step,
              resumed.stepper->advance(resumed.state, 100).step);
  EXPECT_EQ(run.state.t, resumed.state.t);
}

}  // namespace
}  // namespace gnomon::step_control_test
