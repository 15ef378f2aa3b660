#include <cmath>
#include <complex>
#include <gnomon/newton/algebraic_solver.hpp>

#include "support/problem_run.hpp"

namespace gnomon::dahlquist_test {
namespace {

using namespace testing;

const char* const scenes[] = {"dahlquist/decay.toml", "dahlquist/oscillation.toml",
                              "dahlquist/stiff.toml", "dahlquist/nonlinear.toml"};

TEST(Dahlquist, JacobiansEqualCentralDifferences) {
  for (const char* scene : scenes) {
    SCOPED_TRACE(scene);
    const auto model = model_of(scene, {"dahlquist.nonlinearity=0.7"});
    const std::vector<double> y = {0.3, -0.8, 0.6, 0.4};
    check_jacobian(model->system(), 0.3, y, 2.0);
    for (const AlgebraicStage& stage : model->system().algebraic_stages()) {
      stage.freeze(0, y);
      check_jacobian(*stage.system, 0, {0.6, 0.4}, 0);
    }
  }
}

// F(t, y, ydot) = 0 for the closed form, and its rate is its derivative.
TEST(Dahlquist, TheExactSolutionSatisfiesTheEquations) {
  for (const char* scene : scenes) {
    SCOPED_TRACE(scene);
    const auto model = model_of(scene, {"dahlquist.nonlinearity=0.7"});
    Counters counters;
    AlgebraicSolver stages(model->system(), counters);
    for (double t : {0.0, 0.4, 1.3}) {
      State exact = model->exact(t).value();
      ASSERT_EQ(stages.solve(t, exact.y), "");
      std::vector<double> F(4);
      model->system().residual({t, exact.y, exact.ydot}, F);
      for (int i = 0; i < 4; ++i)
        EXPECT_LT(std::abs(F[i]), 1e-10 * model->system().structure().row_scale[i]);
      if (t == 0) continue;
      const double h = 1e-5;
      const State up = model->exact(t + h).value(), down = model->exact(t - h).value();
      for (int i = 0; i < 2; ++i) EXPECT_NEAR((up.y[i] - down.y[i]) / (2 * h), exact.ydot[i], 1e-7);
    }
    const State start = model->start(counters), exact = model->exact(0).value();
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(start.y[i], exact.y[i], 1e-15);
      EXPECT_NEAR(start.ydot[i], exact.ydot[i], 1e-11);
    }
  }
}

TEST(Dahlquist, IsTheTestEquationByDefault) {
  const auto decay = model_of("dahlquist/decay.toml");
  EXPECT_NEAR(decay->exact(2)->y[0], std::exp(-2), 1e-15);
  const auto oscillation = model_of("dahlquist/oscillation.toml");
  EXPECT_NEAR(oscillation->exact(0.125)->y[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(oscillation->exact(0.125)->y[1], std::sqrt(0.5), 1e-15);
  const auto stiff = model_of("dahlquist/stiff.toml");
  EXPECT_NEAR(stiff->exact(2)->y[1], std::sin(2), 1e-15);
}

// One step multiplies y by the stability function: backward Euler 1/(1 - z), theta at 1/2
// (1 + z/2)/(1 - z/2), forward Euler 1 + z.
TEST(Dahlquist, OneStepIsTheStabilityFunction) {
  const auto model = model_of("dahlquist/decay.toml", {"dahlquist.rate_imag=2.5"});
  const double h = 0.4;
  const std::complex<double> z = h * std::complex<double>(-1, 2.5);
  const std::pair<const char*, std::complex<double>> expected[] = {
      {"forward-euler", 1.0 + z},
      {"backward-euler", 1.0 / (1.0 - z)},
      {"theta", (1.0 + z / 2.0) / (1.0 - z / 2.0)}};
  for (const auto& [name, R] : expected) {
    const State end = run_model(*model, name, h, 1e-4, h).last();
    EXPECT_NEAR(end.y[0], R.real(), 1e-10) << name;
    EXPECT_NEAR(end.y[1], R.imag(), 1e-10) << name;
  }
}

TEST(Dahlquist, FixedStepsShowTheOrderOnTheNonLinearEquation) {
  const auto model = model_of("dahlquist/nonlinear.toml");
  const std::pair<const char*, double> expected[] = {
      {"backward-euler", 1}, {"theta", 2}, {"esdirk-3", 3}, {"esdirk-4", 4}, {"esdirk-5", 5}};
  for (const auto& [name, order] : expected) {
    const double coarse = error_of(*model, run_model(*model, name, 1.0 / 16, 1e-4, 2).last());
    const double fine = error_of(*model, run_model(*model, name, 1.0 / 32, 1e-4, 2).last());
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.25) << name << " " << coarse << " " << fine;
  }
}

TEST(Dahlquist, TightRunsMeetTheExactSolution) {
  for (const char* scene : scenes)
    for (const char* name : {"esdirk-4", "bdf"}) {
      const auto model = model_of(scene);
      const ModelRun run = run_model(*model, name, 0, 1e-8, 2);
      EXPECT_LT(error_of(*model, run.last()), 2e-6) << scene << " " << name;
      EXPECT_EQ(observed(*model, run.states.front(), "error"), 0);
      EXPECT_GT(observed(*model, run.last(), "error"), 0);
    }
}

}  // namespace
}  // namespace gnomon::dahlquist_test
