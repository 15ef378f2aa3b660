#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/stability/stability.hpp>
#include <numbers>

#include "../../problems/stressed_surface/configurational_force.hpp"
#include "support/derivatives.hpp"
#include "support/problem_run.hpp"

namespace gnomon::stressed_surface_test {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;
constexpr double mobility = 1e-3, E = 1000, nu = 0.3, sigma = 10, tension = 0.01448309982;
constexpr double neutral = 2 * (1 - nu * nu) * sigma * sigma / (E * tension);  // q_c

std::unique_ptr<Model> wave(double q, int n, Overrides more = {}) {
  more.push_back(fmt::format("surface.size={}", 2 * pi / q));
  more.push_back(fmt::format("mesh.elements=[{}, {}]", n, n));
  return model_of("stressed_surface/wave.toml", more);
}

std::unique_ptr<Model> circle(int n, Overrides more = {}) {
  more.push_back(fmt::format("mesh.elements=[{0}, {0}]", n));
  return model_of("stressed_surface/circle.toml", more);
}

State start_of(const Model& model) {
  Counters counters;
  return model.start(counters);
}

/// The rate of an observation along the motion of a state.
double rate_of(const Model& model, const State& state, const char* name, double dt) {
  const auto at = [&](double t) {
    State moved = state;
    for (std::size_t i = 0; i < moved.y.size(); ++i) moved.y[i] += t * state.ydot[i];
    Counters counters;
    EXPECT_EQ(AlgebraicSolver(model.system(), counters).solve(0, moved.y), "");
    return observed(model, moved, name);
  };
  return (at(dt) - at(-dt)) / (2 * dt);
}

/// Of the amplitude of a very small wave.
double growth(double q, int n) {
  const double amplitude = 1e-5 / q;
  const auto model = wave(q, n, {fmt::format("surface.amplitude={}", amplitude)});
  return rate_of(*model, start_of(*model), "amplitude", 1) / amplitude;
}

TEST(StressedSurface, ConfigurationalForcesAreTheDerivativeOfTheEnergy) {
  const ElasticModuli moduli = ElasticModuli::from_young_poisson(E, nu);
  CellNodal<2> X;
  X << 0, 0, 1, 0.1, 1.2, 0.9, -0.1, 1.1;
  const auto u = noise<CellNodal<2>>(0.1, 1);
  CellNodal<2> differences;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 2; ++i) {
      CellNodal<2> up = X, down = X;
      up(a, i) += 1e-6, down(a, i) -= 1e-6;
      differences(a, i) =
          (stressed::elastic_energy(moduli, up, u) - stressed::elastic_energy(moduli, down, u)) /
          2e-6;
    }
  expect_same_matrix(stressed::configurational_force<>(moduli, X, u), differences, 1e-8);
}

TEST(StressedSurface, JacobianEqualsCentralDifferences) {
  for (const auto& model :
       {wave(2 * pi, 3, {"surface.amplitude=0.02"}),
        circle(2, {"surface.lobes=2", "surface.amplitude=0.05", "surface.reference=0.4"})}) {
    State state = start_of(*model);
    const std::vector<double>& scale = model->system().structure().unknown_scale;
    for (std::size_t i = 0; i < state.y.size(); ++i)
      state.y[i] += 0.02 * scale[i] * std::sin(double(3 * i));
    check_jacobian(model->system(), 0, state.y, 0.2);
  }
}

// dE/dt = - sum over the nodes of M |dX/dt|^2 / m, exactly in the discrete equations, with a large
// wave on a coarse mesh.
TEST(StressedSurface, TheEnergyFallsByWhatTheMotionDissipates) {
  const auto model = wave(2 * pi, 8, {"surface.amplitude=0.06"});
  const State state = start_of(*model);
  const auto X = model->contact(state)->worn;
  std::vector<double> rates;
  for (std::size_t i = 0; i < state.y.size(); ++i)
    if (model->system().structure().differential[i]) rates.push_back(state.ydot[i]);
  ASSERT_EQ(rates.size(), X.size());  // along vertical lines
  double dissipated = 0;
  for (std::size_t k = 0; k < X.size(); ++k)
    for (const std::size_t other : {k - 1, k + 1})
      if (other < X.size()) {
        const double dx = X[other][0] - X[k][0], dy = X[other][1] - X[k][1];
        dissipated += dx * dx / std::hypot(dx, dy) / 2 * rates[k] * rates[k] / mobility;
      }
  const double rate = rate_of(*model, state, "energy", 0.1);
  EXPECT_LT(rate, 0);
  EXPECT_NEAR(rate, -dissipated, 1e-6 * dissipated);
}

// Asaro, Tiller and Grinfeld, on both sides of the neutral wave number.
TEST(StressedSurface, AWaveGrowsAtItsRate) {
  for (const double part : {0.5, 1.5}) {
    const double q = part * neutral;
    const double exact = mobility * tension * q * (neutral - q);
    double error[3];
    for (int k = 0; k < 3; ++k) error[k] = growth(q, 12 << k) / exact - 1;
    std::printf("q = %.1f q_c: errors of the rate with 12, 24, 48 elements: %.2e %.2e %.2e\n", part,
                error[0], error[1], error[2]);
    EXPECT_LT(std::abs(error[2]), 0.01);
    EXPECT_NEAR(error[0] / error[1], 4, 0.5);
    EXPECT_NEAR(error[1] / error[2], 4, 0.5);
  }
}

TEST(StressedSurface, AWaveUnderPressureGrowsAsUnderTension) {
  const auto amplitude = [](const char* stress) {
    const auto model = wave(0.5 * neutral, 12, {stress});
    return observed(*model, run_model(*model, "esdirk-4", 0, 1e-5, 500).last(), "amplitude");
  };
  EXPECT_NEAR(amplitude("load.stress=-10") / amplitude("load.stress=10"), 1, 1e-6);
}

TEST(StressedSurface, ACircleShrinksAndItsLobesDecay) {
  const auto round = circle(2);
  const ModelRun run = run_model(*round, "esdirk-4", 0, 1e-6, 375);
  EXPECT_LT(error_of(*round, run.last()), 1e-5);
  EXPECT_NEAR(observed(*round, run.last(), "area") / observed(*round, run.states[0], "area"), 0.25,
              1e-5);
  // As R^(n^2 - 1); here to R = 0.8 R0.
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const auto lobed = circle(4 << k, {"surface.amplitude=1e-4", "surface.lobes=2"});
    const State end = run_model(*lobed, "esdirk-4", 0, 1e-7, 180).last();
    error[k] = observed(*lobed, end, "amplitude") / (1e-4 * std::pow(0.8, 3)) - 1;
  }
  std::printf("lobes: errors with 8 and 16 elements on a quarter: %.2e %.2e\n", error[0], error[1]);
  EXPECT_LT(std::abs(error[1]), 5e-3);
  EXPECT_NEAR(error[0] / error[1], 4, 0.5);
}

TEST(StressedSurface, TheEnergyNeverGrowsWithAnyMethod) {
  const auto model = wave(2 * pi, 6, {"surface.amplitude=0.02"});
  for (const Integrator& integrator : Integrators::all()) {
    if (integrator.error_estimate.empty()) continue;
    SCOPED_TRACE(integrator.name);
    const ModelRun run = run_model(*model, integrator.name, 0, 1e-2, 1500);
    for (std::size_t k = 1; k < run.states.size(); ++k)
      EXPECT_LE(observed(*model, run.states[k], "energy"),
                observed(*model, run.states[k - 1], "energy"));
    EXPECT_GT(observed(*model, run.last(), "amplitude"), 0.035);
  }
}

// The fastest mode alternates from node to node: 4 m gamma / h^2 by curvature, so that the critical
// step of forward Euler is h^2 / (2 m gamma), while that of wear is proportional to h.
TEST(StressedSurface, TheCriticalStepIsThatOfCurvature) {
  const auto fastest = [](int n) {
    const auto model = wave(0.5 * neutral, n, {"surface.amplitude=0.01"});
    return leading_modes(ReducedJacobian(model->system(), start_of(*model)), 1)
        .front()
        .eigenvalue.real();
  };
  const auto curvature = [](int n) {
    const double h = pi / (0.5 * neutral) / n;
    return -4 * mobility * tension / (h * h);
  };
  const double coarse = fastest(12), fine = fastest(24);
  EXPECT_NEAR(fine / coarse, 4, 0.8);
  EXPECT_NEAR(coarse / curvature(12), 1, 0.2);
  EXPECT_NEAR(fine / curvature(24), 1, 0.1);
}

// Of the polygon of nodes, in closed form.
TEST(StressedSurface, FixedStepsShowTheirOrder) {
  const auto model = circle(2);
  const std::pair<const char*, double> expected[] = {
      {"forward-euler", 1}, {"backward-euler", 1}, {"theta", 2}, {"erk-3", 3}, {"esdirk-4", 4}};
  for (const auto& [name, order] : expected) {
    const double coarse = error_of(*model, run_model(*model, name, 20, 0, 180).last());
    const double fine = error_of(*model, run_model(*model, name, 10, 0, 180).last());
    std::printf("%s: %.2e %.2e, order %.2f\n", name, coarse, fine, std::log2(coarse / fine));
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << name;
  }
}

/// The time of the cusp in the message that ends a run.
double time_of_cusp(const Model& model, const char* integrator) {
  const RunOutcome outcome = run(model, Integrators::find(integrator, "integrator"),
                                 controlled_settings(model, 1e-2, 1e4), {}, nullptr, {});
  EXPECT_EQ(outcome.status, RunOutcome::Status::failed);
  EXPECT_THAT(outcome.diagnosis, ::testing::HasSubstr("sharpens to a cusp at (0.5, -0."));
  std::printf("%s: t = %.1f: %s\n", integrator, outcome.last->t, outcome.diagnosis.c_str());
  const std::string before = "at about t = ";
  return std::stod(outcome.diagnosis.substr(outcome.diagnosis.find(before) + before.size()));
}

TEST(StressedSurface, ACuspEndsARunWithItsTime) {
  const auto model = wave(2 * pi, 12, {"surface.amplitude=0.06"});
  const double reference = time_of_cusp(*wave(2 * pi, 16, {"surface.amplitude=0.06"}), "esdirk-4");
  for (const char* integrator : {"esdirk-4", "bdf"})
    EXPECT_NEAR(time_of_cusp(*model, integrator), reference, 0.1 * reference) << integrator;
}

TEST(StressedSurface, RefusesWhatItCannotDo) {
  EXPECT_THROW(circle(2, {"load.stress=1", "body.young_modulus=1e3", "body.poisson_ratio=0.3"}),
               InputError);
  EXPECT_THROW(circle(2, {"surface.lobes=3"}), InputError);
  EXPECT_THROW(wave(2 * pi, 2, {"surface.amplitude=0.3"}), InputError);
}

}  // namespace
}  // namespace gnomon::stressed_surface_test
