// Orders, agreement and stability of the integrators on the worn pin.

#include <cmath>
#include <gnomon/newton/newton.hpp>

#include "support/pin.hpp"

namespace gnomon::order_test {
namespace {

using namespace testing;

const Overrides coarse = {elements(20)};

TEST(BackwardEuler, IsOfFirstOrderAgainstTightBdf) {
  const Eigen::VectorXd exact = run_pin("bdf", 0, 1e-6, 200, coarse).worn_surface();
  std::vector<double> error;
  for (double step : {10.0, 5.0, 2.5})
    error.push_back(
        (run_pin("backward-euler", step, 0, 200, coarse).worn_surface() - exact).norm());
  for (int k : {0, 1}) EXPECT_NEAR(std::log2(error[k] / error[k + 1]), 1, 0.2);
}

// Two independent methods: BDF by IDA, and backward Euler by KINSOL extrapolated to step zero.
TEST(Bdf, AgreesWithExtrapolatedBackwardEuler) {
  const Eigen::VectorXd bdf = run_pin("bdf", 0, 1e-7, 200, coarse).worn_surface();
  const Eigen::VectorXd h = run_pin("backward-euler", 1.25, 0, 200, coarse).worn_surface();
  const Eigen::VectorXd half = run_pin("backward-euler", 0.625, 0, 200, coarse).worn_surface();
  const Eigen::VectorXd extrapolated = 2 * half - h;
  EXPECT_LT((extrapolated - bdf).norm(), 0.05 * (half - bdf).norm());
}

TEST(Bdf, ErrorFollowsTheTolerance) {
  const Eigen::VectorXd exact = run_pin("bdf", 0, 1e-7, 200, coarse).worn_surface();
  const double loose = (run_pin("bdf", 0, 1e-3, 200, coarse).worn_surface() - exact).norm();
  const double tight = (run_pin("bdf", 0, 1e-5, 200, coarse).worn_surface() - exact).norm();
  EXPECT_LT(tight, 0.1 * loose);
}

// The critical step is proportional to h/E: about 11 s at 40x40 and E = 640, so about 22 s at
// 20x20. Below it the error is that of backward Euler with the same step, above it far larger (fig.
// 5, 6).
double error_ratio(double step, const Overrides& overrides) {
  const Eigen::VectorXd exact = run_pin("bdf", 0, 1e-5, 600, overrides).worn_surface();
  const auto error = [&](const char* method) {
    return (run_pin(method, step, 0, 600, overrides).worn_surface() - exact).norm();
  };
  return error("forward-euler") / error("backward-euler");
}

TEST(ForwardEuler, IsUnstableAboveItsCriticalStepOnly) {
  const double critical = 22;
  const double below = error_ratio(0.6 * critical, coarse);
  const double above = error_ratio(1.6 * critical, coarse);
  const double softer = error_ratio(1.6 * critical, {elements(20), "body.young_modulus=320"});
  EXPECT_LT(below, 2);
  EXPECT_GT(above, 4);
  EXPECT_LT(softer, 2);
}

// Quadratic contraction of one coupled step, from the recorded norms.
TEST(BackwardEuler, NewtonContractsQuadratically) {
  const auto model = pin_model(coarse);
  Counters counters;
  const State start = model->start(counters);
  const System& system = model->system();
  const double h = 10;
  std::vector<double> y = start.y, ydot(y.size());
  const auto difference = [&](std::span<const double> at) {
    for (std::size_t i = 0; i < y.size(); ++i)
      ydot[i] = system.structure().differential[i] ? (at[i] - start.y[i]) / h : 0;
  };
  NewtonSolver newton(system.structure(), counters);
  const NewtonReport report = newton.solve({[&](std::span<const double> at, std::span<double> G) {
                                              difference(at);
                                              system.residual({h, at, ydot}, G);
                                            },
                                            [&](std::span<const double> at, std::span<double> J) {
                                              difference(at);
                                              system.jacobian({h, at, ydot}, 1 / h, J);
                                            }},
                                           y);
  ASSERT_TRUE(report.converged) << report.reason;
  // Digits at least nearly double over the last step that starts inside the region and ends above
  // rounding.
  int checked = 0;
  for (std::size_t k = 1; k + 1 < report.norms.size(); ++k) {
    if (report.norms[k] > 0.1 || report.norms[k] < 1e-7) continue;
    EXPECT_LT(std::log(report.norms[k + 1]), 1.6 * std::log(report.norms[k]));
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace gnomon::order_test
