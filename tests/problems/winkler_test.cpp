#include <algorithm>
#include <chrono>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/system/system.hpp>

#include "support/problem_run.hpp"

namespace gnomon::winkler_test {
namespace {

using namespace testing;

constexpr double F = 20, R = 5, k_v = 1e-4, modulus = 70.33;

std::unique_ptr<Model> winkler(int points, Overrides overrides = {}) {
  overrides.push_back("foundation.points=" + std::to_string(points));
  return model_of("winkler/pin.toml", overrides);
}

struct Errors {
  double depth = 0;     ///< [mm]
  double pressure = 0;  ///< [MPa]
};

/// Largest differences from the closed form over a whole run.
Errors errors(int points) {
  const auto model = winkler(points);
  Errors worst;
  for (const State& state : run_model(*model, "esdirk-4", 0, 1e-8, 300).states) {
    const State exact = model->exact(state.t).value();
    worst.depth = std::max(worst.depth, error_of(*model, state));
    for (std::size_t i = 0; i + 1 < state.y.size(); i += 2)
      worst.pressure = std::max(worst.pressure, std::abs(state.ydot[i] - exact.ydot[i]) / k_v);
  }
  return worst;
}

TEST(Winkler, JacobiansEqualCentralDifferences) {
  const auto model = winkler(9);
  const System& system = model->system();
  Counters counters;
  State state = model->start(counters);
  for (int i = 0; i < 9; ++i) state.y[2 * i] = 0.01 * i;
  ActiveSet active = active_set(system, state.t, state.y);
  const auto closed = std::count(active.begin(), active.end(), 1);
  ASSERT_GT(closed, 0);
  ASSERT_LT(closed, 9);
  check_jacobian(system, 0, state.y, 0.2);
  std::vector<double> part;
  const auto stages = system.algebraic_stages();
  for (int unknown : stages[0].unknowns) part.push_back(state.y[unknown]);
  stages[0].freeze(0, state.y);
  check_jacobian(*stages[0].system, 0, part, 0);
  // The same on another smooth branch, continued beyond its border.
  for (char& point : active) point = !point;
  check_jacobian(system, 0, state.y, 0.2, &active);
  check_jacobian(*stages[0].system, 0, part, 0, &active);
}

TEST(Winkler, TheClosedFormObeysItsEquations) {
  const auto model = winkler(401);
  for (double t : {50.0, 400.0, 1000.0}) {
    const State exact = model->exact(t).value();
    const State up = model->exact(t + 0.01).value(), down = model->exact(t - 0.01).value();
    double area = 0, flux = 0, worst = 0, fastest = 0;
    for (int i = 0; i < 401; ++i) {
      area += exact.y[2 * i] * 0.025;  // nothing is worn at the ends
      flux += exact.ydot[2 * i] * 0.025;
      fastest = std::max(fastest, exact.ydot[2 * i]);
      worst = std::max(worst, std::abs((up.y[2 * i] - down.y[2 * i]) / 0.02 - exact.ydot[2 * i]));
    }
    // Archard, up to the trapezoidal rule; and the rate is the derivative of the depth.
    EXPECT_NEAR(area, k_v * F * t, 1e-4 * k_v * F * t);
    EXPECT_NEAR(flux, k_v * F, 1e-4 * k_v * F);
    EXPECT_LT(worst, 2e-5 * fastest);
  }
  EXPECT_FALSE(model->exact(1e5).has_value());  // the contact would be wider than the pin
}

TEST(Winkler, StartsFromTheParabolaOfPressure) {
  const auto model = winkler(2001);
  Counters counters;
  const State start = model->start(counters);
  const double a_0 = std::cbrt(1.5 * R * F / modulus);
  EXPECT_NEAR(observed(*model, start, "contact_half_width"), a_0, 1e-5);
  EXPECT_NEAR(observed(*model, start, "max_pressure"), modulus * a_0 * a_0 / (2 * R), 1e-4);
  const State exact = model->exact(0).value();
  for (int i = 0; i < 2001; ++i) EXPECT_NEAR(start.ydot[2 * i], exact.ydot[2 * i], 1e-8);
}

// The start of many more would take minutes, which no signal ends.
TEST(Winkler, HasNoMorePointsThanItCanSolve) {
  const auto scene = [](const char* points) {
    load_scene(GNOMON_SOURCE_DIR "/problems/winkler/pin.toml",
               {std::string("foundation.points=") + points}, key_table);
  };
  EXPECT_NO_THROW(scene("50000"));
  EXPECT_THAT([&] { scene("50001"); },
              ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("in [3, 50000]")));
}

TEST(Winkler, ForceAndWearFluxHoldAtEveryStep) {
  const auto model = winkler(101);
  for (const auto& [integrator, step] : {std::pair("forward-euler", 5.0),
                                         {"backward-euler", 50.0},
                                         {"esdirk-4", 0.0},
                                         {"bdf", 0.0}}) {
    const ModelRun run = run_model(*model, integrator, step, 1e-4, 300, false, to_rounding);
    for (const State& state : run.states)
      EXPECT_NEAR(observed(*model, state, "wear_flux") / (k_v * F), 1, 1e-9) << integrator;
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume"), k_v * F * 300, 1e-8) << integrator;
  }
}

// The discrete solution tends to the continuum's. The error of the force by the trapezoidal rule is
// O(h^2) times
// (1 - 6 theta (1 - theta)), theta being where between two points the edge of the contact
// lies; its mean is zero, so that the depth, the pressure's integral over time, gains an order.
TEST(Winkler, ConvergesToTheClosedFormWithThePoints) {
  const int points[] = {26, 51, 101, 201};
  Errors error[4];
  for (int k = 0; k < 4; ++k) {
    error[k] = errors(points[k]);
    std::printf("%d points: depth %.2e mm, pressure %.2e MPa\n", points[k], error[k].depth,
                error[k].pressure);
  }
  EXPECT_NEAR(std::log2(error[0].depth / error[3].depth) / 3, 3, 0.4);
  EXPECT_NEAR(std::log2(error[0].pressure / error[3].pressure) / 3, 2, 0.4);
  EXPECT_LT(error[3].depth, 2e-6);
}

TEST(Winkler, HalfWidthFollowsItsLaw) {
  const auto model = winkler(801);
  const ModelRun run = run_model(*model, "bdf", 0, 1e-6, 300);
  for (std::size_t k = 0; k < run.states.size(); k += 20) {
    const double a = std::cbrt(1.5 * R * (F / modulus + k_v * F * run.states[k].t));
    EXPECT_NEAR(observed(*model, run.states[k], "contact_half_width"), a, 1e-3 * a);
  }
}

TEST(Winkler, TightRunsOfTwoMethodsAgree) {
  const auto model = winkler(201);
  const State a = run_model(*model, "esdirk-4", 0, 1e-8, 300).last();
  const State b = run_model(*model, "bdf", 0, 1e-8, 300).last();
  double difference = 0;
  for (int i = 0; i < 201; ++i)
    difference = std::max(difference, std::abs(a.y[2 * i] - b.y[2 * i]));
  EXPECT_LT(difference, 1e-6);
  EXPECT_GT(error_of(*model, a), difference);  // the remaining difference is the discretization
}

// The branch is smooth: a method that ends its steps on the events keeps its order across them.
TEST(Winkler, LocatedEventsKeepTheOrder) {
  const auto model = winkler(27);
  const State exact = run_model(*model, "esdirk-5", 1.25, 0, 200, true).last();
  const auto error = [&](double step, bool locate) {
    const State state = run_model(*model, "esdirk-4", step, 0, 200, locate).last();
    double worst = 0;
    for (int i = 0; i < 27; ++i) worst = std::max(worst, std::abs(state.y[2 * i] - exact.y[2 * i]));
    return worst;
  };
  for (double step : {20.0, 10.0, 5.0})
    std::printf("step %g: ignored %.2e, located %.2e\n", step, error(step, false),
                error(step, true));
  EXPECT_NEAR(std::log2(error(20, true) / error(5, true)) / 2, 4, 0.7);
  EXPECT_LT(error(5, true), 0.1 * error(5, false));
}

// The arrow: delta last, no fill beyond its row and column.
TEST(Winkler, ThousandsOfPointsFactorWithoutFill) {
  const int n = 4001;
  const auto model = winkler(n);
  Counters counters;
  const State start = model->start(counters);
  const Structure& structure = model->system().structure();
  std::vector<double> values(structure.pattern.nonzeros());
  model->system().jacobian({0, start.y, start.ydot}, 0.1, values);
  SparseLu lu(structure.pattern, structure.group);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(lu.factorize(values));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::printf("factor: %.1f ms, %g nonzeros\n", 1e3 * seconds.count(), lu.factor_nonzeros());
  EXPECT_LT(lu.factor_nonzeros(), 12 * n);
}

}  // namespace
}  // namespace gnomon::winkler_test
