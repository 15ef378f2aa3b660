// Runs whose wear law jumps: what fixed steps cost, and nodes that slide along a jump.
#include <fmt/format.h>

#include <gnomon/integrators/jumps.hpp>
#include <gnomon/run/run.hpp>

#include "support/problem_run.hpp"

namespace gnomon::jump_ledger_test {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double end = 200;

RunOutcome run_springs(const std::string& rate, const std::string& integrator, double step) {
  const auto model = model_of(
      "winkler/pin.toml",
      {"foundation.points=41", fmt::format("time.end={}", end), "wear.rate=\"" + rate + "\""});
  IntegratorSettings settings = controlled_settings(*model, 1e-3, end);
  settings.step = step;
  StorePolicy policy;
  return run(*model, Integrators::find(integrator, "integrator"), settings, policy, nullptr, {});
}

double worn(const RunOutcome& outcome) {
  return value_of(outcome.last->scalars, "worn_volume").value();
}

TEST(JumpLedger, SaysWhatFixedStepsMayMiss) {
  const std::string rate = "k * p * v * if(h < 0.1, 1, 5)";
  const double right = worn(run_springs(rate, "esdirk-4", 0));
  for (const char* integrator : {"backward-euler", "forward-euler", "esdirk-3"}) {
    const RunOutcome outcome = run_springs(rate, integrator, 2);
    EXPECT_THAT(outcome.warnings,
                ElementsAre(HasSubstr("the wear law jumps within fixed steps: the wear depth has "
                                      "an error of up to 0.007")))
        << integrator;
    EXPECT_NEAR(worn(outcome) / right, 1, 0.021);
  }
  EXPECT_THAT(run_springs(rate, "esdirk-3", 0).warnings, IsEmpty());
  EXPECT_THAT(run_springs("k * p * v * max(1, 50 * h)", "esdirk-3", 2).warnings, IsEmpty());
}

// What wears faster loses its pressure, and comes back. A ramp has a solution.
TEST(JumpLedger, EndsRunsThatSlideAlongAJump) {
  for (const auto& [integrator, step] :
       {std::pair("esdirk-3", 0.0), std::pair("bdf", 0.0), std::pair("backward-euler", 2.0),
        std::pair("forward-euler", 2.0), std::pair("erk-3", 0.0)}) {
    const RunOutcome outcome = run_springs("k * p * v * if(p < 8, 1, 5)", integrator, step);
    EXPECT_EQ(outcome.status, RunOutcome::Status::failed) << integrator;
    EXPECT_THAT(outcome.diagnosis, HasSubstr("the wear law jumps")) << integrator;
    EXPECT_THAT(outcome.diagnosis, HasSubstr("no solution")) << integrator;
  }
  const RunOutcome ramp = run_springs("k * p * v * (1 + 4 * min(max(p - 8, 0), 1))", "esdirk-3", 0);
  EXPECT_EQ(ramp.status, RunOutcome::Status::finished);
}

// A condition on both sides of which the rate is the same is a kink, beyond which the branches of
// the one side and of the other differ.
TEST(CommonJump, IsThatOfAJumpAndNoneOfAKink) {
  const auto jump = [](const std::string& rate) {
    const auto model =
        model_of("winkler/pin.toml", {"foundation.points=41", "wear.rate=\"" + rate + "\""});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, end);
    const CrossedJumps crossed =
        jumps_between(model->system(), run.states.front(), run.last(), false);
    EXPECT_FALSE(crossed.functions.empty());
    double largest = 0;
    for (const std::size_t function : crossed.functions)
      largest =
          std::max(largest, common_jump(model->system(), run.states.front(), run.last(), function));
    return largest;
  };
  EXPECT_EQ(jump("k * p * v * if(h < 0.005, 1, 1 + 50 * (h - 0.005))"), 0);
  EXPECT_GT(jump("k * p * v * if(h < 0.005, 1, 5)"), 4 * 1e-7 * 1000);
}

}  // namespace
}  // namespace gnomon::jump_ledger_test
