// Short steps before stored times, which settle the pressures of stiff bodies.
#include <gnomon/integrators/stop_times.hpp>

#include "ball/coarse.hpp"
#include "support/problem_run.hpp"

namespace gnomon {
namespace {

using namespace testing;

TEST(SettlingStop, TwoShortStepsLeadToEachTime) {
  IntegratorSettings settings;
  settings.rtol = 1e-2;
  settings.end = 1000;
  settings.settled = {100, 500};
  const auto expect = [&](double t, double stop, bool settles) {
    const SettlingStop next = settling_stop(settings, t, 1000);
    EXPECT_DOUBLE_EQ(next.t, stop) << t;
    EXPECT_EQ(next.settles, settles) << t;
  };
  expect(0, 98, false);  // 0.01 of 100 s
  expect(settling_stop(settings, 0, 1000).t, 99, true);
  expect(98.5, 99, true);  // as behind an event
  expect(settling_stop(settings, 98.5, 1000).t, 100, true);
  expect(100, 492, false);  // 0.01 of 400 s
  expect(500, 1000, false);
  EXPECT_EQ(settling_stop(settings, 0, 50).t, 50);  // an earlier stop

  settings.rtol = 1e-9;  // 1e-5 of the time
  expect(0, 99.998, false);
  settings.step = 10;  // fixed steps keep their grid
  expect(99.999, 1000, false);
}

IntegratorSettings settings_of(const Model& model, double rtol, double end) {
  IntegratorSettings settings;
  settings.rtol = rtol;
  settings.scale = model.differential_scale();
  settings.atol = rtol * settings.scale;
  settings.end = end;
  settings.nonlinear_fraction = 0.01;
  return settings;
}

/// Pressures at the end of a stiff ball on a coarse mesh, and the work.
struct Worn {
  std::vector<double> pressure;
  double wear_integral;
  long newton_iterations;
};
Worn worn_ball(const std::string& integrator, double rtol, bool settled) {
  const auto model = model_of(ball_small, ball_mesh(5, 2, 3));
  Counters counters;
  State state = model->start(counters);
  IntegratorSettings settings = settings_of(*model, rtol, 1000);
  settings.integrand = model->wear_flux();
  if (settled) settings.settled = {500, 1000};
  const auto stepper =
      Integrators::find(integrator, "integrator").make(model->system(), settings, counters);
  double integral = 0;
  for (const double stop : {500.0, 1000.0})
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
  EXPECT_LT(distance(worn_ball("esdirk-3", 1e-4, true).pressure, exact.pressure), 0.02);
  for (const char* integrator : {"esdirk-2", "esdirk-3", "bdf"}) {
    const Worn plain = worn_ball(integrator, 1e-2, false),
               settled = worn_ball(integrator, 1e-2, true);
    EXPECT_GT(distance(plain.pressure, exact.pressure), 0.1) << integrator;
    EXPECT_LT(distance(settled.pressure, exact.pressure), 0.05) << integrator;
    EXPECT_LT(settled.newton_iterations, 1.3 * plain.newton_iterations) << integrator;
  }
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

}  // namespace
}  // namespace gnomon
