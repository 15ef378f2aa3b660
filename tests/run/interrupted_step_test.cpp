// A run that is interrupted within a step ends with the state before it, and in the start without
// one.
#include <gtest/gtest.h>

#include <gnomon/run/run.hpp>

#include "support/pin.hpp"

namespace gnomon::interrupted_step_test {
namespace {

using namespace testing;

// The run asks once before each step, and then before each Newton iteration of it.
TEST(InterruptedStep, EndsAtTheLastOne) {
  const auto model = model_of("winkler/pin.toml", {"foundation.points=21"});
  IntegratorSettings settings;
  settings.step = 0.5;
  settings.end = 4;
  long steps = 0, asked = 0;
  std::vector<double> times;
  RunHooks hooks;
  hooks.on_step = [&](const HistoryRow& row) { steps = row.counters.steps, asked = 0; };
  hooks.on_state = [&](const State& state) { times.push_back(state.t); };
  hooks.interrupted = [&] { return steps == 2 && ++asked == 2; };
  const RunOutcome outcome =
      run(*model, Integrators::find("backward-euler", "integrator"), settings, {}, nullptr, hooks);
  EXPECT_EQ(outcome.text(), "interrupted");
  EXPECT_EQ(times.back(), 1);
  ASSERT_TRUE(outcome.state);
  EXPECT_EQ(outcome.state->t, 1);
}

TEST(InterruptedStep, MayBeTheStart) {
  const auto model = model_of("winkler/pin.toml", {"foundation.points=21"});
  RunHooks hooks;
  hooks.interrupted = [] { return true; };
  const RunOutcome outcome =
      run(*model, Integrators::find("backward-euler", "integrator"), {}, {}, nullptr, hooks);
  EXPECT_EQ(outcome.text(), "interrupted");
  EXPECT_FALSE(outcome.last);
  EXPECT_EQ(outcome.counters.newton_iterations, 0);
}

}  // namespace
}  // namespace gnomon::interrupted_step_test
