// Epochs: a model that is followed by another one in the same run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/run/run.hpp>

#include "support/problem_run.hpp"
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

IntegratorSettings settings_of(const Model& model, const Case& c, double fraction) {
  IntegratorSettings settings = controlled_settings(model, 1e-5, end);
  settings.step = c.step;
  settings.locate_events = c.locate;
  settings.nonlinear_fraction = fraction;
  return settings;
}

RunOutcome outcome_of(const Model& model, const Case& c, double fraction = to_rounding,
                      ResultWriter* writer = nullptr, const RunHooks& hooks = {},
                      const StorePolicy& policy = {}, const Resumption* from = nullptr) {
  return run(model, Integrators::find(c.integrator, "integrator"), settings_of(model, c, fraction),
             policy, writer, hooks, from);
}

/// The last state, in the unknowns of the model without epochs.
std::vector<double> inner_y(const RenumberedModel& first, const RunOutcome& outcome) {
  const auto* last = dynamic_cast<const RenumberedModel*>(outcome.successor.get());
  return (last ? *last : first).inner(*outcome.state).y;
}

double largest_difference(const Model& model, const std::vector<double>& a,
                          const std::vector<double>& b) {
  const std::vector<double>& scale = model.system().structure().unknown_scale;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / scale[i]);
  return largest;
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
    EXPECT_NEAR(outcome.last->scalars.back().value, plain.last->scalars.back().value,
                1e-9 * std::abs(plain.last->scalars.back().value));
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

// ---- results

class EpochResults : public ::testing::TestWithParam<bool> {
protected:
  EpochResults() { std::filesystem::create_directories(folder_); }
  ~EpochResults() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  RunOutcome write(const std::filesystem::path& path, const Model& model, long most_steps = 1000,
                   const Resumption* from = nullptr) const {
    ResultWriter writer(
        path,
        {.problem = "p", .integrator = "i", .scene = "s", .versions = {}, .blocks = model.blocks},
        model.grid);
    if (from) copy_to_last_checkpoint(ResultReader(file("cut.h5")), names(model, from), writer);
    long steps = 0;
    RunHooks hooks{.on_step = [&](const HistoryRow& row) { steps = row.counters.steps; }};
    hooks.interrupted = [&] { return steps >= most_steps; };
    return outcome_of(model, {"esdirk-3", 0}, to_rounding, &writer, hooks,
                      {.every = 1, .checkpoint_seconds = 1e-9}, from);
  }
  static std::vector<std::string> names(const Model& first, const Resumption* from) {
    const auto later = model_of_epoch(first, from->epochs);
    const Model& model = later ? *later : first;
    std::vector<std::string> result;
    for (const GridField& field : model.fields(state_at(from->checkpoint, model)))
      result.push_back(field.name);
    return result;
  }

private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("gnomon-epochs-" + std::to_string(getpid()));
};

TEST_P(EpochResults, ARunThatWasCutInALaterEpochGoesOnToTheSameResult) {
  const auto model = body();
  const RenumberedModel renumbered(model, {.interval = 30, .renumber = GetParam()});
  const RunOutcome whole = write(file("whole.h5"), renumbered);
  ASSERT_GT(whole.counters.steps, 5);
  write(file("cut.h5"), renumbered, whole.counters.steps - 2);
  const ResultReader cut(file("cut.h5"));
  Resumption from{.checkpoint = cut.checkpoints().back(), .row = {}};
  ASSERT_GE(from.checkpoint.epoch, 1);
  from.epochs = cut.epochs();
  from.epochs.resize(static_cast<std::size_t>(from.checkpoint.epoch));
  from.row = cut.history()[static_cast<std::size_t>(from.checkpoint.rows) - 1];
  from.stored = cut.stored_times()[static_cast<std::size_t>(from.checkpoint.stored) - 1];
  const RunOutcome resumed = write(file("resumed.h5"), renumbered, 1000, &from);
  EXPECT_EQ(resumed.counters.steps, whole.counters.steps);
  EXPECT_LT(largest_difference(*model, resumed.state->y, whole.state->y), 1e-8);
  EXPECT_EQ(resumed.epochs, whole.epochs);
  const ResultReader a(file("whole.h5")), b(file("resumed.h5"));
  EXPECT_EQ(a.epochs().size(), static_cast<std::size_t>(whole.epochs) - 1);
  EXPECT_EQ(b.epochs().size(), a.epochs().size());
  EXPECT_EQ(b.stored_times(), a.stored_times());
  const std::size_t last = a.stored_times().size() - 1;
  const std::vector<double> shape = a.field(last, "shape").values;
  EXPECT_THAT(b.field(last, "shape").values,
              ::testing::Pointwise(::testing::DoubleNear(1e-9), shape));
  EXPECT_EQ(a.epoch_of(0), 0u);
  EXPECT_EQ(a.epoch_of(last), static_cast<std::size_t>(whole.epochs) - 1);
  EXPECT_EQ(a.grid(a.epoch_of(last))->points, model->grid->points);
}

INSTANTIATE_TEST_SUITE_P(Results, EpochResults, ::testing::Bool());

}  // namespace
}  // namespace gnomon
