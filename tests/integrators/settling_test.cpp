// Short steps before stored times, which settle the pressures of stiff bodies.
#include <gnomon/integrators/closings.hpp>
#include <gnomon/integrators/stop_times.hpp>

#include "ball/coarse.hpp"
#include "support/problem_run.hpp"

namespace gnomon::settling_test {
namespace {

using namespace testing;

TEST(Settling, IsAShortIntervalBeforeEachTime) {
  IntegratorSettings settings;
  settings.rtol = 1e-2;
  settings.end = 1000;
  settings.settled = {100, 500};
  Structure structure;
  const auto expect = [&](double t, double begin, double end) {
    const auto settling = next_settling(structure, settings, t);
    ASSERT_TRUE(settling) << t;
    EXPECT_DOUBLE_EQ(settling->begin, begin) << t;
    EXPECT_DOUBLE_EQ(settling->end, end) << t;
  };
  expect(0, 98, 100);  // two steps of 0.01 of 100 s
  expect(99.5, 98, 100);
  expect(100, 492, 500);  // of 400 s
  EXPECT_FALSE(next_settling(structure, settings, 500));
  const Settling settling{492, 500};
  EXPECT_DOUBLE_EQ(settling.shorter(492), 498);
  EXPECT_DOUBLE_EQ(settling.shorter(498), 499.5);
  EXPECT_DOUBLE_EQ(settling.shorter(499.9), 500);  // too short to settle anything
  settings.max_step = 1;
  expect(0, 99, 100);  // both of them
  settings.max_step = 0;
  structure.breakpoints = {98, 100, 495};
  expect(0, 98, 100);                                     // at its ends
  EXPECT_FALSE(next_settling(structure, settings, 100));  // in it
  settings.rtol = 1e-8;                                   // 1e-4 of the time
  expect(100, 499.92, 500);
  settings.end = 1e7;  // too short beside it
  EXPECT_FALSE(next_settling(structure, settings, 0));
  settings.end = 1000;
  settings.step = 10;  // fixed steps keep their grid
  EXPECT_FALSE(next_settling(structure, settings, 0));
}

TEST(Settling, FollowsTheNodesThatCloseInTheLastSteps) {
  Closings closings(2);
  closings.begin({0, 1, 0});
  EXPECT_FALSE(closings.recent());  // at the start
  EXPECT_FALSE(closings.closes({0, 0, 0}));
  EXPECT_TRUE(closings.closes({1, 0, 0}));
  closings.accept({1, 1, 0}, false);
  EXPECT_TRUE(closings.recent());
  closings.accept({1, 0, 0}, false);
  EXPECT_TRUE(closings.recent());
  closings.accept({1, 0, 0}, false);
  EXPECT_FALSE(closings.recent());
  closings.accept({1, 1, 0}, false);
  closings.accept({1, 1, 0}, true);  // by short steps
  EXPECT_FALSE(closings.recent());
  closings.accept({1, 1, 1}, true);  // closed in them
  EXPECT_TRUE(closings.recent());
}

IntegratorSettings settings_of(const Model& model, double rtol, double end) {
  IntegratorSettings settings = controlled_settings(model, rtol, end);
  settings.nonlinear_fraction = 0.01;
  return settings;
}

/// Pressures at the end of a stiff ball on a coarse mesh, and the work.
struct Worn {
  std::vector<double> pressure;
  double wear_integral;
  long newton_iterations;
};
Worn worn_ball(const std::string& integrator, double rtol, bool settled,
               const std::vector<double>& times = {500, 1000}) {
  const auto model = model_of(ball_small, ball_mesh(5, 2, 3));
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings = settings_of(*model, rtol, 1000);
  settings.integrand = model->wear_flux;
  if (settled) settings.settled = times;
  const auto stepper =
      Integrators::find(integrator, "integrator").make(model->system(), settings, counters);
  double integral = 0;
  for (const double stop : times)
    while (state.t < stop) integral += stepper->advance(state, stop).integral;
  return {model->contact(state)->pressure, integral, counters.newton_iterations};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most / *std::max_element(b.begin(), b.end());
}

// Two accurate runs by different methods agree, also one that was not settled. At a loose tolerance
// the pressure at the edge is wrong by a large part of the peak unless it is settled.
TEST(Settling, MakesPressuresOfAStiffBallAccurate) {
  const Worn exact = worn_ball("bdf", 1e-4, true);
  EXPECT_LT(distance(worn_ball("esdirk-4", 1e-4, true).pressure, exact.pressure), 0.003);
  for (const char* integrator : {"esdirk-2", "esdirk-3", "bdf"}) {
    const Worn plain = worn_ball(integrator, 1e-2, false),
               settled = worn_ball(integrator, 1e-2, true);
    EXPECT_GT(distance(plain.pressure, exact.pressure), 0.1) << integrator;
    EXPECT_LT(distance(settled.pressure, exact.pressure), 0.05) << integrator;
    EXPECT_LT(settled.newton_iterations, 1.3 * plain.newton_iterations) << integrator;
  }
}

// Its differential components hardly change in steps so short: Newton's method does not end for
// that.
TEST(Settling, EndsInEquilibrium) {
  const auto model = model_of(ball_small, ball_mesh(5, 2, 3));
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings = settings_of(*model, 1e-2, 1000);
  settings.settled = {1000};
  const auto stepper =
      Integrators::find("esdirk-3", "integrator").make(model->system(), settings, counters);
  while (state.t < 1000) stepper->advance(state, 1000);
  std::vector<double> residual(state.y.size());
  model->system().residual({state.t, state.y, state.ydot}, residual);
  const Structure& structure = model->system().structure();
  double most = 0;
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!structure.differential[i])
      most = std::max(most, std::abs(residual[i]) / structure.row_scale[i]);
  EXPECT_LT(most, 1e-9);
}

// A node closes in the last step to 1000 s, which is as long as bdf likes because none has closed
// in the steps before: the step is taken back.
TEST(Settling, TakesBackAStepOfBdfInWhichANodeCloses) {
  const Worn exact = worn_ball("esdirk-4", 1e-4, true);
  const Worn worn = worn_ball("bdf", 1e-2, true, {200, 400, 600, 800, 1000});
  EXPECT_LT(distance(worn.pressure, exact.pressure), 0.05);
  EXPECT_NEAR(worn.wear_integral, 5, 5e-4);
}

// The short steps count in the wear integral by their own formula: K mu F v t.
TEST(Settling, KeepsTheWearIntegral) {
  for (const char* integrator : {"esdirk-3", "bdf"})
    EXPECT_NEAR(worn_ball(integrator, 1e-2, true).wear_integral, 5, 5e-4) << integrator;
}

// Their error is below the tolerance, also a tight one.
TEST(Settling, KeepsTheErrorOfTightTolerances) {
  const auto depth = [](double rtol, bool settled) {
    const auto model = model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[10,10]"});
    Counters counters;
    State state = model->start(counters);
    IntegratorSettings settings = settings_of(*model, rtol, 400);
    std::vector<double> times;
    for (int k = 1; k <= 8; ++k) times.push_back(50 * k);
    if (settled) settings.settled = times;
    const auto stepper =
        Integrators::find("esdirk-4", "integrator").make(model->system(), settings, counters);
    for (const double stop : times)
      while (state.t < stop) stepper->advance(state, stop);
    return model->contact(state)->wear_depth;
  };
  const std::vector<double> exact = depth(1e-9, false);
  for (const double rtol : {1e-4, 1e-6})
    EXPECT_LT(distance(depth(rtol, true), exact), 3 * rtol) << rtol;
}

struct WornPin {
  std::vector<double> depth;
  Counters counters;
};
/// The pin at 1000 s, with the given load, settled at multiples of `interval` or not.
WornPin worn_pin(const std::string& integrator, double rtol, bool settled, double interval,
                 const Overrides& further = {}) {
  Overrides overrides = {"mesh.elements=[10,10]"};
  overrides.insert(overrides.end(), further.begin(), further.end());
  const auto model = model_of("pin_on_flat/small_deformation.toml", overrides);
  WornPin worn;
  State state = model->start(worn.counters);
  IntegratorSettings settings = settings_of(*model, rtol, 1000);
  std::vector<double> times;
  for (double t = interval; t <= 1000; t += interval) times.push_back(t);
  if (settled) settings.settled = times;
  const auto stepper =
      Integrators::find(integrator, "integrator").make(model->system(), settings, worn.counters);
  for (const double stop : times)
    while (state.t < stop) stepper->advance(state, stop);
  worn.depth = model->contact(state)->wear_depth;
  return worn;
}

// Short steps whose error is too large are taken back: those to 1000 s begin at 998 s, where the
// load has come within half a second, and the pressures change for the rest of the time.
TEST(Settling, KeepsTheErrorRightAfterAFastLoad) {
  const Overrides fast = {"load.times=[0,997.5,998,1000]", "load.factors=[1e-3,1e-3,1,1]"};
  const WornPin exact = worn_pin("esdirk-4", 1e-8, false, 1000, fast);
  const WornPin run = worn_pin("esdirk-3", 1e-6, true, 1000, fast);
  EXPECT_LT(distance(run.depth, exact.depth), 1e-6);
  EXPECT_GE(run.counters.rejected_steps, 1);
}

// Where stored times set the steps, short steps before each of them would cost two factorizations:
// only those at which a node has closed need them (five pairs of nodes close in this run).
TEST(Settling, CostsLittleWhereManyStatesAreStored) {
  for (const char* integrator : {"esdirk-3", "bdf"}) {
    SCOPED_TRACE(integrator);
    const Counters plain = worn_pin(integrator, 1e-3, false, 10).counters;
    const Counters settled = worn_pin(integrator, 1e-3, true, 10).counters;
    EXPECT_LE(settled.steps, 1.15 * plain.steps);
    EXPECT_LE(settled.factorizations, plain.factorizations + 12);
    EXPECT_LE(settled.newton_iterations, 1.3 * plain.newton_iterations);
  }
}

// A closing before a checkpoint decides about the steps after it.
TEST(Settling, GoesOnWithItsMemoryAsItWould) {
  const auto model = model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[20,6]"});
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings = settings_of(*model, 1e-2, 400);
  settings.max_step = 4;  // several steps between the times
  for (int k = 1; k <= 20; ++k) settings.settled.push_back(20 * k);
  const Integrator& integrator = Integrators::find("esdirk-3", "integrator");
  const auto stepper = integrator.make(model->system(), settings, counters);
  int short_ones = 0;
  for (const double stop : settings.settled)
    while (state.t < stop) {
      const auto resumed = integrator.make(model->system(), settings, counters);
      State other = state;
      if (state.t > 0) resumed->restore(state, stepper->memory());
      const StepReport report = stepper->advance(state, stop);
      EXPECT_NEAR(resumed->advance(other, stop).step, report.step, 1e-3 * report.step) << other.t;
      short_ones += report.order == 1;
    }
  EXPECT_GT(short_ones, 0);
}

}  // namespace
}  // namespace gnomon::settling_test
