// A run with epochs that is cut in a later one and resumed, compared with one that is not.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <gnomon/run/run.hpp>

#include "support/problem_run.hpp"

namespace gnomon::testing {

inline double largest_difference(const Model& model, const std::vector<double>& a,
                                 const std::vector<double>& b) {
  const std::vector<double>& scale = model.system().structure().unknown_scale;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / scale[i]);
  return largest;
}

/// Runs of a model by esdirk-3 to results in a folder of their own.
class CutRun {
public:
  CutRun(const Model& model, double end) : model_(model), end_(end) {
    std::filesystem::create_directories(folder_);
  }
  ~CutRun() { std::filesystem::remove_all(folder_); }

  void expect_to_go_on() const {
    const RunOutcome whole = write("whole.h5");
    ASSERT_GT(whole.counters.steps, 5);
    ASSERT_GE(whole.epochs, 2);
    write("cut.h5", whole.counters.steps - 2);
    const ResultReader cut(folder_ / "cut.h5");
    Resumption from{.checkpoint = cut.checkpoints().back(), .row = {}};
    ASSERT_GE(from.checkpoint.epoch, 1);
    from.epochs = cut.epochs();
    from.epochs.resize(static_cast<std::size_t>(from.checkpoint.epoch));
    from.row = cut.history()[static_cast<std::size_t>(from.checkpoint.rows) - 1];
    from.stored = cut.stored_times()[static_cast<std::size_t>(from.checkpoint.stored) - 1];
    const RunOutcome resumed = write("resumed.h5", 1000, &from);
    EXPECT_EQ(resumed.counters.steps, whole.counters.steps);
    EXPECT_LT(largest_difference(*whole.successor, resumed.state->y, whole.state->y), 1e-8);
    EXPECT_EQ(resumed.epochs, whole.epochs);
    compare_results(static_cast<std::size_t>(whole.epochs));
  }

private:
  RunOutcome write(const std::string& name, long most_steps = 1000,
                   const Resumption* from = nullptr) const {
    ResultWriter writer(
        folder_ / name,
        {.problem = "p", .integrator = "i", .scene = "s", .versions = {}, .blocks = model_.blocks},
        model_.grid);
    if (from) copy_to_last_checkpoint(ResultReader(folder_ / "cut.h5"), names(from), writer);
    long steps = 0;
    RunHooks hooks{.on_step = [&](const HistoryRow& row) { steps = row.counters.steps; }};
    hooks.interrupted = [&] { return steps >= most_steps; };
    IntegratorSettings settings = controlled_settings(model_, 1e-5, end_);
    settings.nonlinear_fraction = to_rounding;
    return run(model_, Integrators::find("esdirk-3", "integrator"), settings,
               {.every = 1, .checkpoint_seconds = 1e-9}, &writer, hooks, from);
  }
  std::vector<std::string> names(const Resumption* from) const {
    const auto later = model_of_epoch(model_, from->epochs);
    const Model& model = later ? *later : model_;
    std::vector<std::string> result;
    for (const GridField& field : model.fields(state_at(from->checkpoint, model)))
      result.push_back(field.name);
    return result;
  }
  void compare_results(std::size_t epochs) const {
    const ResultReader a(folder_ / "whole.h5"), b(folder_ / "resumed.h5");
    EXPECT_EQ(a.epochs().size(), epochs - 1);
    EXPECT_EQ(b.epochs().size(), epochs - 1);
    EXPECT_EQ(b.stored_times(), a.stored_times());
    const std::size_t last = a.stored_times().size() - 1;
    const std::vector<double> shape = a.field(last, "shape").values;
    EXPECT_THAT(b.field(last, "shape").values,
                ::testing::Pointwise(::testing::DoubleNear(1e-9), shape));
    EXPECT_EQ(a.epoch_of(0), 0u);
    EXPECT_EQ(a.epoch_of(last), epochs - 1);
    EXPECT_EQ(a.grid(a.epoch_of(last))->points, model_.grid->points);
  }

  const Model& model_;
  double end_;
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("gnomon-epochs-" + std::to_string(getpid()));
};

}  // namespace gnomon::testing
