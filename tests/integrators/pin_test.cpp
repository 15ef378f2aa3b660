// Integrators on the worn pin: agreement, order with located events, stability, failures.

#include "support/pin.hpp"

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/diagonally_implicit.hpp>
#include <gnomon/integrators/stepper.hpp>

namespace gnomon::pin_test {
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

// The rates change quickly behind an event, and the error estimate of a long step would not see it:
// errors were eight times as large as this bound.
TEST(LocatedEvents, AreFollowedByStepsAsShortAsTheFirst) {
  const double rtol = 1e-4;
  const Overrides pin = {elements(20)};
  const auto surface = [&](const std::string& integrator, double tolerance) {
    return run_pin(integrator, 0, tolerance, 600, pin, true).worn_surface();
  };
  const Eigen::VectorXd exact = surface("esdirk-5", 1e-7);
  for (const char* integrator : {"esdirk-3", "esdirk-4"})
    EXPECT_LT((surface(integrator, rtol) - exact).norm(), rtol) << integrator;
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

// With error control the same tolerance gives similar errors for all methods, within two orders of
// magnitude.
TEST(Adaptive, EveryMethodKeepsTheTolerance) {
  const Eigen::VectorXd exact = located("esdirk-5", 0, 1e-8, 200).worn_surface();
  for (const Integrator& integrator : Integrators::all()) {
    const PinRun run = run_pin(integrator.name, 0, 1e-3, 200, coarse);
    const double depth = run.model->differential_scale;
    EXPECT_LT((run.worn_surface() - exact).norm(), 100 * 1e-3 * depth) << integrator.name;
    EXPECT_GT(run.counters.steps, 3) << integrator.name;
  }
}

TEST(Adaptive, ModifiedNewtonFactorizesSeldom) {
  const PinRun run = run_pin("esdirk-4", 0, 1e-4, 400, {elements(20)});
  EXPECT_LT(3 * run.counters.factorizations, run.counters.newton_iterations);
}

/// A one-step "method" that fails above a step size, to test its driver.
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
  void interpolate(double, std::span<double>) const override {}

  bool continued = false;

private:
  double largest_;
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

/// One step of backward Euler from the start, E = 20 MPa.
struct FirstStep {
  std::unique_ptr<Model> model = pin_model({elements(10), "body.young_modulus=20"});
  Counters counters;
  State start = model->start(counters), end;
  Attempt attempt;

  FirstStep(double step, bool continuation) {
    IntegratorSettings settings;
    settings.step = settings.end = step;
    settings.rtol = settings.atol = settings.scale = 1;
    const auto table = Integrators::find("backward-euler", "integrator").table(settings);
    DiagonallyImplicit method(model->system(), settings, counters, *table);
    method.accept(start, true);
    attempt = method.attempt(start, step, {.continuation = continuation}, end);
  }
};

// 20000 s remove 4 mm of the 10 mm of the pin in one step.
TEST(Continuation, RescuesAStepThatNewtonCannotTake) {
  const FirstStep plain(20000, false), continued(20000, true);
  EXPECT_FALSE(plain.attempt.success);
  EXPECT_THAT(plain.attempt.reason, ::testing::HasSubstr("inverted element"));
  ASSERT_TRUE(continued.attempt.success) << continued.attempt.reason;
  // The step is that of backward Euler: the equations hold at its end with the rate (d1 - d0) / h.
  const Structure& structure = continued.model->system().structure();
  State end = continued.end;
  for (long i = 0; i < structure.size; ++i)
    end.ydot[i] = structure.differential[i] ? (end.y[i] - continued.start.y[i]) / 20000 : 0;
  std::vector<double> F(end.y.size());
  continued.model->system().residual({end.t, end.y, end.ydot}, F);
  for (long i = 0; i < structure.size; ++i)
    ASSERT_LE(std::abs(F[i]), 1e-8 * structure.row_scale[i]) << "row " << i;
}

// 100000 s would remove 20 mm: this step does not exist.
TEST(Continuation, SaysHowFarItCameAndWhy) {
  const FirstStep step(100000, true);
  EXPECT_FALSE(step.attempt.success);
  EXPECT_THAT(step.attempt.reason,
              ::testing::MatchesRegex(".*(inverted element|did not converge|cycles).*"
                                      "continuation in the step reached 0\\.[0-9]+ of it\\)"));
}

// More wear than the height: halving and continuation fail as well, and the run ends with time and
// reason.
TEST(Continuation, ARunThatWearsItsBodyThroughEndsWithTheReason) {
  try {
    run_pin("backward-euler", 5000, 1e-4, 1e5, {elements(4), "pin.height=3.5"});
    FAIL() << "no exception";
  } catch (const SolutionError& error) {
    EXPECT_THAT(error.what(),
                ::testing::MatchesRegex("no step from t = [0-9.]+ s succeeds, down to .*: "
                                        "(inverted element|Newton did not converge|.*cycles).*"));
  }
}

// A located event is a change of the active set, and no set changes otherwise: nodes do not switch
// back and forth after it because of rounding. By symmetry two nodes switch at a time.
TEST(Pin, LocatedEventsAreTheChangesOfTheActiveSet) {
  for (const char* integrator : {"esdirk-3", "bdf"}) {
    SCOPED_TRACE(integrator);
    const PinRun run = located(integrator, 0, 1e-6, 1000);
    ASSERT_GT(run.counters.events, 1);
    double active = observed(*run.model, run.states.front(), "contact_nodes");
    long changes = 0;
    for (std::size_t k = 0; k < run.reports.size(); ++k) {
      const double now = observed(*run.model, run.states[k + 1], "contact_nodes");
      EXPECT_GE(now, active);
      changes += now != active;
      EXPECT_EQ(run.reports[k].switched % 2, 0);
      active = now;
    }
    EXPECT_EQ(run.counters.events, changes);
  }
}

}  // namespace
}  // namespace gnomon::pin_test
