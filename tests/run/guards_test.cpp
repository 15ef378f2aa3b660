// The checks that end a run whose numbers are worthless, or that makes no progress.
#include "run/guards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>

#include "support/problem_run.hpp"

namespace gnomon::guards_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

// ---- lack of progress

TEST(ProgressWatch, EndsARunThatGoesNowhereFor5000Iterations) {
  Counters counters;
  counters.newton_iterations = 700;  // those of the start are not counted
  ProgressWatch watch(10, counters, 1000);
  counters.newton_iterations = 5699;
  EXPECT_NO_THROW(watch.require(10.001, counters));
  counters.newton_iterations = 5700;
  EXPECT_THAT(
      [&] { watch.require(10.0099, counters); },
      ::testing::ThrowsMessage<SolutionError>(HasSubstr(
          "lack of progress: the last 5000 Newton iterations and steps went from t = 10 s to")));
}

TEST(ProgressWatch, CountsStepsThatNeedNoIteration) {
  Counters counters;
  ProgressWatch watch(10, counters, 1000);
  counters.steps = 5000;
  EXPECT_THROW(watch.require(10.002, counters), SolutionError);
}

TEST(ProgressWatch, BeginsAnewWhereTheRunHasProgressed) {
  Counters counters;
  ProgressWatch watch(0, counters, 1000);
  counters.newton_iterations = 6000;
  EXPECT_NO_THROW(watch.require(0.011, counters));  // 1e-5 of 1000 is 0.01
  counters.newton_iterations = 10999;
  EXPECT_NO_THROW(watch.require(0.012, counters));
  counters.newton_iterations = 11000;
  EXPECT_THROW(watch.require(0.012, counters), SolutionError);
}

// ---- damping

const Integrator& integrator(const std::string& name) {
  return Integrators::find(name, "integrator");
}

TEST(MayFailToDamp, IsForFixedStepsOfMethodsThatDoNotDampStiffModes) {
  IntegratorSettings settings;
  EXPECT_FALSE(may_fail_to_damp(integrator("forward-euler"), settings));  // steps follow the error
  settings.step = 1;
  for (const char* name : {"forward-euler", "erk-2", "erk-4", "theta"})
    EXPECT_TRUE(may_fail_to_damp(integrator(name), settings)) << name;
  for (const char* name : {"backward-euler", "sdirk-2", "esdirk-3", "esdirk-5", "bdf"})
    EXPECT_FALSE(may_fail_to_damp(integrator(name), settings)) << name;
  settings.own["integrator.alpha"] = 0.8;
  EXPECT_FALSE(may_fail_to_damp(integrator("theta"), settings));
}

/// A mode of -50 /s over 5 s: the critical step of forward Euler is 0.04 s.
struct Watched {
  std::unique_ptr<Model> model =
      model_of("dahlquist/decay.toml", {"dahlquist.rate_real=-50.0", "dahlquist.rate_imag=0.0"});
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings;

  void require(const std::string& name, double step, double end) {
    settings.step = step;
    settings.end = end;
    DampingWatch watch(*model, integrator(name), settings);
    watch.require_damping(state);
    EXPECT_TRUE(watch.has_seen_a_mode());
  }
};

TEST(DampingWatch, EndsStepsAboveTheCriticalOne) {
  Watched watched;
  EXPECT_NO_THROW(watched.require("forward-euler", 0.039, 5));
  EXPECT_THAT([&] { watched.require("forward-euler", 0.041, 5); },
              ::testing::ThrowsMessage<SolutionError>(
                  HasSubstr("steps of 0.041 s exceed the critical one of forward-euler")));
}

TEST(DampingWatch, EndsTrapezoidalStepsThatLeaveHalfOfAMode) {
  Watched watched;
  EXPECT_NO_THROW(watched.require("theta", 0.1, 5));
  // R(-50) = -24/26: 0.67 of it are left after five steps.
  EXPECT_THAT([&] { watched.require("theta", 1, 5); },
              ::testing::ThrowsMessage<SolutionError>(HasSubstr("would be left")));
}

TEST(DampingWatch, LetsModesBeThatHardlyDecayInTheRun) {
  Watched watched;
  EXPECT_NO_THROW(watched.require("forward-euler", 0.041, 0.045));  // exp(-2.25) > 0.1
}

TEST(DampingWatch, LooksAgainWhereContactHasBecomeWiderByAFifth) {
  Watched watched;
  watched.settings.step = 0.041;
  watched.settings.end = 5;
  DampingWatch watch(*watched.model, integrator("forward-euler"), watched.settings);
  const auto look = [&](double nodes) {
    watch.require_damping_in_wider_contact(watched.state, {common("contact_nodes", nodes)});
  };
  EXPECT_THROW(look(10), SolutionError);
  EXPECT_NO_THROW(look(12));  // has been checked already
  EXPECT_THROW(look(12.1), SolutionError);
}

// ---- chattering

ContactSurface surface(const std::vector<char>& active) {
  ContactSurface surface;
  surface.active.assign(active.begin(), active.end());
  return surface;
}

TEST(Chattering, IsToLeaveContactTwiceBetweenBreakpoints) {
  Chattering chattering;
  chattering.add(std::nullopt);
  for (const std::vector<char>& active :
       std::vector<std::vector<char>>{{1, 1, 0}, {0, 1, 1}, {1, 0, 0}})
    chattering.add(surface(active));
  EXPECT_EQ(chattering.nodes(), 0);
  chattering.add(surface({0, 0, 0}));  // the first for the second time
  EXPECT_EQ(chattering.nodes(), 1);
  EXPECT_THROW(require_no_chattering(chattering.nodes(), integrator("forward-euler")),
               SolutionError);

  chattering.begin_anew();
  EXPECT_EQ(chattering.nodes(), 1);  // is remembered
  chattering.add(surface({0, 1, 0}));
  chattering.add(surface({0, 0, 0}));  // the second: once before and once after the breakpoint
  EXPECT_EQ(chattering.nodes(), 1);
}

TEST(Chattering, GoesOnWithItsNumbers) {
  Chattering chattering, resumed;
  for (const std::vector<char>& active : std::vector<std::vector<char>>{{1, 1}, {0, 1}, {1, 1}})
    chattering.add(surface(active));
  std::vector<double> packed;
  chattering.pack_into(packed);
  Unpacker numbers(packed);
  resumed.unpack_from(numbers);
  resumed.add(surface({0, 0}));
  EXPECT_EQ(resumed.nodes(), 1);
  EXPECT_THROW(resumed.add(surface({0})), InputError);
}

}  // namespace
}  // namespace gnomon::guards_test
