// Integrators on the worn pin: agreement, order with located events, stability, failures.

#include "support/pin.hpp"

#include <cmath>

#include <gnomon/error.hpp>
#include <gnomon/integration/stepper.hpp>

namespace gnomon {
namespace {

using namespace testing;

const Overrides coarse = {elements(10)};

PinRun located(const std::string& integrator, double step, double rtol, double end) {
  return run_pin(integrator, step, rtol, end, coarse, true);
}

// Two methods of different families, both error-controlled and tight.
TEST(LocatedEvents, EsdirkAgreesWithBdf) {
  const Eigen::VectorXd esdirk = located("esdirk-5", 0, 1e-8, 400).worn_surface();
  const Eigen::VectorXd bdf = located("bdf", 0, 1e-8, 400).worn_surface();
  const Eigen::VectorXd ignoring = run_pin("bdf", 0, 1e-8, 400, coarse).worn_surface();
  EXPECT_LT((esdirk - bdf).norm(), 2e-8);
  EXPECT_LT((esdirk - ignoring).norm(), 2e-8);
}

TEST(LocatedEvents, BringTheOrderBack) {
  const Eigen::VectorXd exact = located("esdirk-5", 0, 1e-10, 400).worn_surface();
  const auto error = [&](double step, bool locate) {
    return (run_pin("esdirk-4", step, 1e-4, 400, coarse, locate).worn_surface() - exact).norm();
  };
  const double coarse_step = error(20, true), fine_step = error(10, true);
  EXPECT_NEAR(std::log2(coarse_step / fine_step), 4, 0.5);
  EXPECT_LT(fine_step, 0.02 * error(10, false));
}

TEST(LocatedEvents, EndStepsOnSymmetricPairs) {
  const PinRun run = located("esdirk-4", 20, 1e-4, 400);
  int events = 0;
  for (std::size_t k = 0; k < run.reports.size(); ++k) {
    if (run.reports[k].switched == 0) continue;
    ++events;
    EXPECT_EQ(run.reports[k].switched, 2);  // both sides of the pin at once
  }
  EXPECT_GT(events, 0);
  EXPECT_EQ(run.counters.events, events);
  EXPECT_EQ(run.counters.rejected_steps, 0);
}

// Steps follow the error: the same tolerance means the same for all, within two orders.
TEST(Adaptive, EveryMethodKeepsTheTolerance) {
  const Eigen::VectorXd exact = located("esdirk-5", 0, 1e-8, 200).worn_surface();
  for (const Integrator& integrator : Integrators::all()) {
    const PinRun run = run_pin(integrator.name, 0, 1e-3, 200, coarse);
    const double depth = run.model->differential_scale();
    EXPECT_LT((run.worn_surface() - exact).norm(), 100 * 1e-3 * depth) << integrator.name;
    EXPECT_GT(run.counters.steps, 3) << integrator.name;
  }
}

TEST(Adaptive, ModifiedNewtonFactorizesSeldom) {
  const PinRun run = run_pin("esdirk-4", 0, 1e-4, 400, {elements(20)});
  EXPECT_LT(3 * run.counters.factorizations, run.counters.newton_iterations);
}

/// A one-step "method" that fails above a size, to see what drives it do.
class Fragile : public OneStepMethod {
public:
  explicit Fragile(double largest) : largest_(largest) {}
  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override {
    continued |= options.continuation;
    if (h > largest_) return {.reason = "too long"};
    to = from;
    to.t = from.t + h;
    return {.success = true};
  }
  void accept(const State&, bool) override {}
  const Trace& trace() const override { return trace_; }

  bool continued = false;

private:
  double largest_;
  Trace trace_;
};

struct Driven {
  std::unique_ptr<Model> model = pin_model({elements(4)});
  Counters counters;
  Fragile* method = nullptr;
  State state;
  std::unique_ptr<OneStepStepper> stepper;

  explicit Driven(double largest) {
    IntegratorSettings settings;
    settings.step = 10;
    settings.end = 100;
    auto owned = std::make_unique<Fragile>(largest);
    method = owned.get();
    stepper = std::make_unique<OneStepStepper>(model->system(), settings, counters,
                                               std::move(owned), 1, 1);
    state = model->start(counters);
    counters = {};
  }
};

TEST(FixedSteps, AreHalvedAfterAFailureAndReturnToTheGrid) {
  Driven run(3);
  std::vector<double> times;
  while (run.state.t < 20) {
    run.stepper->advance(run.state, 100);
    times.push_back(run.state.t);
  }
  EXPECT_THAT(times, ::testing::Contains(10.0));  // exactly
  EXPECT_EQ(times.back(), 20.0);
  EXPECT_GT(run.counters.rejected_steps, 0);
  EXPECT_EQ(run.counters.steps, static_cast<long>(times.size()));
}

TEST(FixedSteps, GiveUpWithTheReasonAndTheLastGoodState) {
  Driven run(0);
  const std::vector<double> y = run.state.y;
  try {
    run.stepper->advance(run.state, 100);
    FAIL() << "no exception";
  } catch (const SolutionError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("too long"));
  }
  EXPECT_EQ(run.state.t, 0);
  EXPECT_EQ(run.state.y, y);
  EXPECT_TRUE(run.method->continued);  // shorter steps first, then continuation
}

}  // namespace
}  // namespace gnomon
