// Epochs: a model that is followed by another one in the same run.
#include <gtest/gtest.h>

#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/run/run.hpp>

#include "support/cut_run.hpp"
#include "support/renumbered.hpp"

namespace gnomon {
namespace {

using namespace testing;

constexpr double end = 200;

struct Case {
  const char* integrator;
  double step;  // 0: error control
  bool locate = false;
};

IntegratorSettings settings_of(const Model& model, const Case& c) {
  IntegratorSettings settings = controlled_settings(model, 1e-5, end);
  settings.step = c.step;
  settings.locate_events = c.locate;
  settings.nonlinear_fraction = to_rounding;
  return settings;
}

RunOutcome outcome_of(const Model& model, const Case& c) {
  return run(model, Integrators::find(c.integrator, "integrator"), settings_of(model, c), {},
             nullptr, {});
}

/// The last state, in the unknowns of the model without epochs.
std::vector<double> inner_y(const RenumberedModel& first, const RunOutcome& outcome) {
  const auto* last = dynamic_cast<const RenumberedModel*>(outcome.successor.get());
  return (last ? *last : first).inner(*outcome.state).y;
}

std::shared_ptr<const Model> pin() {
  return model_of("winkler/pin.toml", {"foundation.points=41", "time.end=200"});
}
std::shared_ptr<const Model> body() {
  return model_of("pin_on_flat/small_deformation.toml",
                  {"mesh.elements=[6,6]", "time.end=200", "solver.method=direct"});
}

class Renumbered : public ::testing::TestWithParam<Case> {};

TEST_P(Renumbered, OneStepMethodsTakeTheSameStepsToTheSameState) {
  for (const auto& model : {pin(), body()}) {
    const RunOutcome plain = outcome_of(*model, GetParam());
    const RenumberedModel renumbered(model, {.interval = 30});
    const RunOutcome outcome = outcome_of(renumbered, GetParam());
    ASSERT_EQ(outcome.text(), "finished");
    EXPECT_GE(outcome.epochs, 4);
    EXPECT_EQ(outcome.restarts, 0);
    EXPECT_EQ(outcome.counters.steps, plain.counters.steps);
    EXPECT_LT(largest_difference(*model, inner_y(renumbered, outcome), plain.state->y), 1e-8);
    const double depth = *value_of(plain.last->scalars, "wear_depth");
    EXPECT_NEAR(*value_of(outcome.last->scalars, "wear_depth"), depth, 1e-9 * depth);
  }
}

INSTANTIATE_TEST_SUITE_P(Epochs, Renumbered,
                         ::testing::Values(Case{"forward-euler", 2}, Case{"backward-euler", 10},
                                           Case{"esdirk-3", 0}, Case{"esdirk-4", 0, true},
                                           Case{"erk-3", 2}),
                         [](const auto& info) {
                           std::string name = info.param.integrator;
                           std::erase(name, '-');
                           return name + (info.param.locate ? "Located" : "");
                         });

TEST(Epochs, BdfRestartsWhereTheUnknownsChangeAndItIsCounted) {
  const auto model = pin();
  const Case bdf{"bdf", 0};
  const RunOutcome plain = outcome_of(*model, bdf);
  const RenumberedModel renumbered(model, {.interval = 50});
  const RunOutcome outcome = outcome_of(renumbered, bdf);
  EXPECT_EQ(outcome.epochs, 4);
  EXPECT_EQ(outcome.restarts, 3);
  EXPECT_GT(outcome.counters.steps, plain.counters.steps);  // order one at first
  EXPECT_LT(largest_difference(*model, inner_y(renumbered, outcome), plain.state->y), 1e-3);
}

TEST(Epochs, BdfGoesOnWhereOnlyThePatternIsNew) {
  for (const bool locate : {false, true}) {
    const auto model = body();
    const Case bdf{"bdf", 0, locate};
    const RunOutcome plain = outcome_of(*model, bdf);
    const RenumberedModel wider(model, {.interval = 50, .renumber = false});
    const RunOutcome outcome = outcome_of(wider, bdf);
    EXPECT_EQ(outcome.epochs, 4);
    EXPECT_EQ(outcome.restarts, 0);
    EXPECT_EQ(outcome.counters.steps, plain.counters.steps);
    EXPECT_LT(largest_difference(*model, outcome.state->y, plain.state->y), 1e-8);
  }
}

TEST(Epochs, CyclesGoOnAcrossThem) {
  const std::shared_ptr<const Model> model =
      model_of("winkler/cycle.toml", {"cycle.phases=4", "foundation.points=21"});
  const Case method{"esdirk-3", 0};
  IntegratorSettings settings = controlled_settings(*model, 1e-7, 5000);
  settings.nonlinear_fraction = to_rounding;
  const Integrator& integrator = Integrators::find(method.integrator, "integrator");
  const RunOutcome plain = run(*model, integrator, settings, {}, nullptr, {});
  const RenumberedModel renumbered(model, {.interval = 1000});
  const RunOutcome outcome = run(renumbered, integrator, settings, {}, nullptr, {});
  EXPECT_GE(outcome.epochs, 3);
  EXPECT_EQ(outcome.counters.steps, plain.counters.steps);
  EXPECT_LT(largest_difference(*model, inner_y(renumbered, outcome), plain.state->y), 1e-8);
}

class EpochResults : public ::testing::TestWithParam<bool> {};

TEST_P(EpochResults, ARunThatWasCutInALaterEpochGoesOnToTheSameResult) {
  const RenumberedModel renumbered(body(), {.interval = 30, .renumber = GetParam()});
  CutRun(renumbered, end).expect_to_go_on();
}

INSTANTIATE_TEST_SUITE_P(Results, EpochResults, ::testing::Bool());

}  // namespace
}  // namespace gnomon
