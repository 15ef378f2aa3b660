// Newton iterations that end by the tolerated error of the step, against iterations to rounding.
#include <algorithm>
#include <gnomon/integrators/diagonally_implicit.hpp>
#include <gnomon/integrators/error_norm.hpp>

#include "support/problem_run.hpp"

namespace gnomon::newton_accuracy_test {
namespace {

using namespace testing;

struct PinOf {
  std::unique_ptr<Model> model =
      model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[10,10]"});
  IntegratorSettings settings;
  ModelRun run;

  PinOf(const std::string& integrator, double rtol, double fraction, bool locate = false) {
    settings = controlled_settings(*model, rtol, 1000);
    run = run_model(*model, integrator, 0, rtol, 1000, locate, fraction);
  }
  double size(const std::vector<double>& y, const std::vector<double>& other,
              const std::vector<double>& at) const {
    return ErrorNorm(model->system().structure(), settings).distance(y, other, at);
  }
};

/// The largest distance of the end of a step from that of the same step with solves to rounding, in
/// units of the tolerated error.
double largest_distance(const std::string& integrator, double rtol, double fraction) {
  const PinOf run(integrator, rtol, fraction);
  Counters counters;
  DiagonallyImplicit exact(run.model->system(), run.settings, counters,
                           *Integrators::find(integrator, "integrator").table(run.settings));
  double largest = 0;
  for (std::size_t k = 0; k + 1 < run.run.states.size(); ++k) {
    const State &from = run.run.states[k], &to = run.run.states[k + 1];
    State solved;
    exact.accept(from, k == 0);
    EXPECT_TRUE(exact.attempt(from, run.run.reports[k].step, {}, solved).success);
    largest = std::max(largest, run.size(to.y, solved.y, from.y));
  }
  return largest;
}

// One solve per step shows the estimate itself, which is not a bound: a factor of two is left for
// it. With more stages the errors of all go into the end of the step, by b_j / a_jj; for sdirk-4
// these factors add up to 69, and its stages are solved more accurately.
TEST(NewtonAccuracy, StaysWithinTheFractionInEveryStep) {
  for (const double rtol : {1e-3, 1e-4})
    for (const double fraction : {0.1, 0.01}) {
      SCOPED_TRACE(::testing::Message() << "rtol " << rtol << ", fraction " << fraction);
      EXPECT_LE(largest_distance("backward-euler", rtol, fraction), 2 * fraction);
      EXPECT_LE(largest_distance("esdirk-3", rtol, fraction), 8 * fraction);
      EXPECT_LE(largest_distance("esdirk-4", rtol, fraction), 8 * fraction);
      EXPECT_LE(largest_distance("sdirk-4", rtol, fraction), 8 * fraction);
    }
}

TEST(NewtonAccuracy, WithoutAFractionIsRounding) {
  EXPECT_LE(largest_distance("esdirk-3", 1e-4, 0), 1e-6);
}

struct FixedCase {
  const char* integrator;
  double step;
  long most_iterations;           // of the run to 1000 s
  double change_of_error = 0.02;  // at most, relative
};

class FixedSteps : public ::testing::TestWithParam<FixedCase> {
protected:
  static constexpr double end = 1000;

  FixedSteps() : settings_(controlled_settings(*model_, 1e-4, end)) {}
  ModelRun run(double fraction) const {
    return run_model(*model_, GetParam().integrator, GetParam().step, 1e-4, end, false, fraction);
  }
  const std::unique_ptr<Model> model_ =
      model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[10,10]"});
  const IntegratorSettings settings_;
};

// For less work, and as accurate: the error of the run is that to rounding within 2 %; of theta,
// whose estimate exceeds the error, within a quarter.
TEST_P(FixedSteps, SaveIterationsAndKeepTheError) {
  static const ModelRun exact = run_model(*model_, "esdirk-5", 0, 1e-8, end, true, to_rounding);
  const ErrorNorm norm(model_->system().structure(), settings_);
  const ModelRun to_rounding = run(0), run = this->run(0.01);
  const auto error = [&](const ModelRun& run) {
    return norm.distance(run.last().y, exact.last().y, exact.last().y);
  };
  EXPECT_EQ(run.counters.steps, to_rounding.counters.steps);
  EXPECT_LT(run.counters.newton_iterations, GetParam().most_iterations);
  EXPECT_GT(to_rounding.counters.newton_iterations, 1.5 * GetParam().most_iterations);
  EXPECT_NEAR(error(run) / error(to_rounding), 1, GetParam().change_of_error);
}

INSTANTIATE_TEST_SUITE_P(OfOneStepMethods, FixedSteps,
                         ::testing::Values(FixedCase{"backward-euler", 5, 300},
                                           FixedCase{"backward-euler", 50, 60},
                                           FixedCase{"forward-euler", 5, 450},
                                           FixedCase{"theta", 5, 400, 0.25},
                                           FixedCase{"erk-2", 5, 900}),
                         [](const auto& info) {
                           std::string name = info.param.integrator;
                           std::ranges::replace(name, '-', '_');
                           return name + "_" + std::to_string(int(info.param.step)) + "_s";
                         });

// The estimate of an embedded method of lower order is far above the error of a fixed step, so that
// a part of it would spoil the order: such steps are solved to rounding.
TEST(NewtonAccuracy, FixedStepsOfEmbeddedPairsAreSolvedToRounding) {
  const auto model = model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[10,10]"});
  for (const char* integrator : {"sdirk-2", "esdirk-3"}) {
    const ModelRun run = run_model(*model, integrator, 100, 1e-4, 1000, false, 0.01),
                   to_rounding = run_model(*model, integrator, 100, 1e-4, 1000, false, 0);
    EXPECT_EQ(run.counters.newton_iterations, to_rounding.counters.newton_iterations);
    EXPECT_EQ(run.last().y, to_rounding.last().y);
  }
}

// The whole run: for less work as accurate, or with an error to which every step may contribute its
// fraction.
TEST(NewtonAccuracy, SavesIterationsAndKeepsTheError) {
  const ModelRun exact = PinOf("esdirk-5", 1e-8, 0, true).run;
  for (const char* integrator : {"bdf", "esdirk-3", "esdirk-4", "sdirk-2"}) {
    SCOPED_TRACE(integrator);
    const PinOf to_rounding(integrator, 1e-4, 0), run(integrator, 1e-4, 0.01);
    EXPECT_LT(run.run.counters.newton_iterations, 0.6 * to_rounding.run.counters.newton_iterations);
    const auto error = [&](const PinOf& run) {
      return run.size(run.run.last().y, exact.last().y, exact.last().y);
    };
    const double allowed = 0.01 * static_cast<double>(run.run.counters.steps);
    EXPECT_LT(error(run), std::max(1.5 * error(to_rounding), allowed));
  }
}

}  // namespace
}  // namespace gnomon::newton_accuracy_test
