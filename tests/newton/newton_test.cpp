#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/newton.hpp>

namespace gnomon::newton_test {
namespace {

/// x^2 + y^2 = 4, x y = 1: two coupled equations on a full pattern.
struct CircleAndHyperbola {
  Structure structure;
  CircleAndHyperbola() {
    structure.size = 2;
    PatternBuilder builder(2);
    builder.add({0, 1}, {0, 1});
    structure.pattern = builder.build();
    structure.group = {0, 0};
    structure.differential = {0, 0};
    structure.row_scale = structure.unknown_scale = {1, 1};
  }
  NonlinearFunction function() const {
    return {[](std::span<const double> y, std::span<double> G) {
              G[0] = y[0] * y[0] + y[1] * y[1] - 4;
              G[1] = y[0] * y[1] - 1;
            },
            [](std::span<const double> y, std::span<double> J) {
              J[0] = 2 * y[0], J[1] = y[1], J[2] = 2 * y[1], J[3] = y[0];
            }};
  }
};

TEST(NewtonSolver, ConvergesQuadraticallyToTheExactSolution) {
  const CircleAndHyperbola problem;
  Counters counters;
  NewtonSolver newton(problem.structure, counters);
  std::vector<double> y = {2, 1};
  const NewtonReport report = newton.solve(problem.function(), y);
  ASSERT_TRUE(report.converged) << report.reason;
  // (x + y)^2 = 6, (x - y)^2 = 2
  EXPECT_NEAR(y[0], (std::sqrt(6) + std::sqrt(2)) / 2, 1e-12);
  EXPECT_NEAR(y[1], (std::sqrt(6) - std::sqrt(2)) / 2, 1e-12);
  EXPECT_EQ(counters.newton_iterations, report.iterations);
  EXPECT_EQ(counters.jacobian_evaluations, report.iterations);
  EXPECT_EQ(counters.factorizations, report.iterations);
  EXPECT_EQ(counters.residual_evaluations, report.iterations + 1);
  EXPECT_EQ(report.norms.size(), static_cast<std::size_t>(report.iterations) + 1);
}

TEST(NewtonSolver, HalvesAStepIntoAStateWithoutResidual) {
  const CircleAndHyperbola problem;
  Counters counters;
  NewtonSolver newton(problem.structure, counters);
  NonlinearFunction guarded = problem.function();
  int refused = 0;
  guarded.residual = [&, inner = problem.function().residual](std::span<const double> y,
                                                              std::span<double> G) {
    if (y[0] > 2.2) {
      ++refused;
      throw RecoverableError("outside");
    }
    inner(y, G);
  };
  std::vector<double> y = {0.8, 0.5};  // the first full step leads outside
  const NewtonReport report = newton.solve(guarded, y);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_GT(refused, 0);
}

TEST(NewtonSolver, SaysWhyItFailed) {
  const CircleAndHyperbola problem;
  Counters counters;
  NewtonSolver newton(problem.structure, counters);
  NonlinearFunction unsolvable = problem.function();
  unsolvable.residual = [](std::span<const double> y, std::span<double> G) {
    G[0] = y[0] * y[0] + 1;
    G[1] = y[1];
  };
  unsolvable.jacobian = [](std::span<const double> y, std::span<double> J) {
    J[0] = 2 * y[0], J[1] = 0, J[2] = 0, J[3] = 1;
  };
  std::vector<double> y = {0.7, 1};
  const NewtonReport report = newton.solve(unsolvable, y);
  EXPECT_FALSE(report.converged);
  EXPECT_THAT(report.reason, ::testing::HasSubstr("did not converge"));

  unsolvable.residual = [](std::span<const double>, std::span<double>) {
    throw RecoverableError("inverted element 12 at (1, 2)");
  };
  EXPECT_EQ(newton.solve(unsolvable, y).reason, "inverted element 12 at (1, 2)");
  unsolvable.residual = [](std::span<const double>, std::span<double> G) {
    G[0] = std::nan("");
    G[1] = 0;
  };
  EXPECT_EQ(newton.solve(unsolvable, y).reason, "the residual is not finite");
}

TEST(NewtonSolver, SingularJacobianIsAFailureNotACrash) {
  const CircleAndHyperbola problem;
  Counters counters;
  NewtonSolver newton(problem.structure, counters);
  std::vector<double> y = {0, 0};
  const NewtonReport report = newton.solve(problem.function(), y);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.reason, "the Jacobian is singular");
}

// An exception that is not recoverable crosses KINSOL's C frames as a code and is rethrown
// unchanged.
TEST(NewtonSolver, LetsForeignExceptionsThrough) {
  const CircleAndHyperbola problem;
  Counters counters;
  NewtonSolver newton(problem.structure, counters);
  NonlinearFunction broken = problem.function();
  broken.jacobian = [](std::span<const double>, std::span<double>) { throw std::bad_alloc(); };
  std::vector<double> y = {2, 1};
  EXPECT_THROW(newton.solve(broken, y), std::bad_alloc);
  y = {2, 1};
  EXPECT_TRUE(newton.solve(problem.function(), y).converged);  // and the solver is still usable
}

/// alpha (y - 2) + e^y = 0, the equation of a step of 1 / alpha from 2, together with x y = 1.
struct ShortStep {
  CircleAndHyperbola structure;
  double alpha;
  explicit ShortStep(double alpha) : alpha(alpha) { structure.structure.differential[0] = 1; }
  NonlinearFunction function() const {
    NonlinearFunction function{[alpha = alpha](std::span<const double> y, std::span<double> G) {
                                 G[0] = alpha * (y[0] - 2) + std::exp(y[0]);
                                 G[1] = y[0] * y[1] - 1;
                               },
                               [alpha = alpha](std::span<const double> y, std::span<double> J) {
                                 J[0] = alpha + std::exp(y[0]), J[1] = 0, J[2] = y[1], J[3] = y[0];
                               }};
    function.rate_weight = alpha;
    return function;
  }
};

// The residual cannot become smaller than the rounding error of alpha y, for every step size. The
// tolerance of the other rows does not change.
TEST(NewtonSolver, AsksOfRatesNoMoreThanRoundingLeaves) {
  for (const double alpha : {1e2, 1e6, 1e10, 1e13}) {
    SCOPED_TRACE(alpha);
    const ShortStep problem(alpha);
    Counters counters;
    NewtonSolver newton(problem.structure.structure, counters, modified_newton);
    std::vector<double> y = {2.1, 0.7};
    const NewtonReport report = newton.solve(problem.function(), y);
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_LT(report.iterations, 12);
    EXPECT_NEAR(alpha * (y[0] - 2) + std::exp(y[0]), 0, std::max(1e-11, 1e-14 * alpha));
    EXPECT_NEAR(y[0] * y[1], 1, 1e-11);
  }
}

}  // namespace
}  // namespace gnomon::newton_test
