// A solution that ends: the drivers of SUNDIALS approach its end, then report its time and the
// reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>

#include "support/problem_run.hpp"

namespace gnomon::failure_test {
namespace {

using ::testing::HasSubstr;

/// The equations of a model up to t = 1; later they have no residual.
class Ending : public System {
public:
  explicit Ending(const System& system) : system_(system) {}
  const Structure& structure() const override { return system_.structure(); }
  void residual(const Point& at, std::span<double> F) const override {
    if (at.t > 1) throw RecoverableError("nothing is left");
    system_.residual(at, F);
  }
  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    system_.jacobian(at, alpha, values);
  }
  void switching(const Point& at, std::span<double> values) const override {
    system_.switching(at, values);
  }
  std::vector<AlgebraicStage> algebraic_stages() const override {
    return system_.algebraic_stages();
  }

private:
  const System& system_;
};

class EndingModel : public Model {
public:
  explicit EndingModel(std::unique_ptr<Model> model)
      : model_(std::move(model)), system_(model_->system()) {
    static_cast<ModelFacts&>(*this) = *model_;
  }
  const System& system() const override { return system_; }
  State start(Counters& counters) const override { return model_->start(counters); }
  Observation observe(const State& state) const override { return model_->observe(state); }
  std::vector<GridField> fields(const State&) const override { return {}; }
  std::optional<ContactSurface> contact(const State&) const override { return std::nullopt; }

private:
  std::unique_ptr<Model> model_;
  Ending system_;
};

class Failure : public ::testing::TestWithParam<const char*> {};

TEST_P(Failure, ComesWhereTheSolutionEndsAndNamesTheReason) {
  const EndingModel model(testing::model_of("dahlquist/decay.toml"));
  Counters counters;
  State state = model.start(counters);
  IntegratorSettings settings;
  settings.rtol = settings.atol = 1e-4;
  settings.scale = model.differential_scale;
  settings.end = 2;
  const auto stepper =
      Integrators::find(GetParam(), "integrator").make(model.system(), settings, counters);
  const auto run = [&] {
    while (state.t < settings.end) stepper->advance(state, settings.end);
  };
  EXPECT_THAT(run, ::testing::ThrowsMessage<SolutionError>(HasSubstr("nothing is left")));
  EXPECT_LE(state.t, 1);
  EXPECT_GT(state.t, 0.99);
  EXPECT_GT(counters.rejected_steps, 0);
}

/// Fails after a thousand Newton iterations at every step size.
class Laborious : public OneStepMethod {
public:
  Laborious(Counters& counters, int& attempts) : counters_(counters), attempts_(attempts) {}
  Attempt attempt(const State&, double, const AttemptOptions&, State&) override {
    ++attempts_;
    counters_.newton_iterations += 1000;
    return {.reason = "nothing comes of it"};
  }
  void accept(const State&, bool) override {}
  void interpolate(double, std::span<double>) const override {}

private:
  Counters& counters_;
  int& attempts_;
};

// Sixteen attempts are made if they cost little.
TEST(OneStep, IsGivenUpAfterFiveThousandNewtonIterations) {
  const auto model = testing::model_of("dahlquist/decay.toml");
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings;
  settings.rtol = settings.atol = 1e-4;
  settings.scale = 1;
  settings.end = 1;
  int attempts = 0;
  OneStepStepper stepper(model->system(), settings, counters,
                         std::make_unique<Laborious>(counters, attempts), 1, 1);
  EXPECT_THAT([&] { stepper.advance(state, settings.end); },
              ::testing::ThrowsMessage<SolutionError>(HasSubstr("nothing comes of it")));
  EXPECT_EQ(attempts, 5);
  EXPECT_EQ(state.t, 0);
}

INSTANTIATE_TEST_SUITE_P(Drivers, Failure, ::testing::Values("bdf", "erk-3"), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace gnomon::failure_test
