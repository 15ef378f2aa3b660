// The end of a Newton iteration by the tolerated error of the step (NewtonOptions::fraction).
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/newton/newton.hpp>

#include "newton/newton_policy.hpp"

namespace gnomon::time_error_test {
namespace {

using Verdict = NewtonPolicy::Verdict;

NewtonOptions options_with(double fraction) {
  return within_time_error(modified_newton, fraction);
}

// ---- the policy

/// Judges the iterates of a contraction by `rate` from a distance of one to the solution, with
/// residuals far below NewtonOptions::balance; returns the distance at which it is done.
double distance_at_the_end(const NewtonOptions& options, double rate) {
  NewtonPolicy policy(options);
  policy.begin();
  double distance = 1, change = std::numeric_limits<double>::infinity();
  while (policy.judge({.residual = 1e-5 * distance, .change = change}) == Verdict::go_on) {
    if (policy.plan().set_up) policy.factors_made();
    change = (1 - rate) * distance;
    distance *= rate;
  }
  return distance;
}

// The steps to come are a geometric series: the estimate is exact.
TEST(TimeError, EndsAKnownContractionAtTheFirstIterateThatIsNearEnough) {
  for (const double rate : {0.01, 0.1, 0.19, 0.5})
    for (const double fraction : {1e-3, 0.02, 0.3}) {
      SCOPED_TRACE(::testing::Message() << "rate " << rate << ", fraction " << fraction);
      const double distance = distance_at_the_end(options_with(fraction), rate);
      EXPECT_LE(distance, fraction);
      EXPECT_GT(distance, fraction * rate);
    }
}

TEST(TimeError, WithoutAFractionEndsAtTheResidual) {
  EXPECT_LE(1e-5 * distance_at_the_end(options_with(0), 0.1), modified_newton.tolerance);
}

TEST(TimeError, IsNotKnownAtAGuess) {
  NewtonPolicy policy(options_with(0.3));
  policy.begin();
  EXPECT_EQ(policy.judge({.residual = 1e-10, .change = 0}), Verdict::go_on);
}

TEST(TimeError, WantsForcesInBalance) {
  for (const double level : {1.0, 1e-3})
    for (const auto& [residual, verdict] :
         {std::pair(1.1e-3, Verdict::go_on), std::pair(0.9e-3, Verdict::done)}) {
      NewtonPolicy policy(options_with(0.3));
      policy.begin();
      policy.judge({1}), policy.plan(), policy.factors_made();
      EXPECT_EQ(policy.judge({.residual = level * residual, .change = 1e-3, .level = level}),
                verdict);
    }
}

TEST(TimeError, WantsARate) {
  NewtonPolicy policy(options_with(0.3));
  policy.begin();
  policy.judge({1e-5}), policy.plan(), policy.factors_made();
  EXPECT_EQ(policy.judge({.residual = 1e-5, .change = 1e-9}),
            Verdict::go_on);  // no contraction
}

// The equations beyond the border of a branch are others: what the last step contracted says
// nothing about them.
TEST(TimeError, IsNotEstimatedAcrossAChangeOfTheActiveSet) {
  const ActiveSet open = {0, 1}, closed = {1, 1};
  NewtonPolicy policy(options_with(0.3));
  policy.begin();
  policy.judge({1, open}), policy.plan(), policy.factors_made();
  EXPECT_EQ(policy.judge({.residual = 1e-8, .branch = closed, .change = 1e-8}), Verdict::go_on);
  EXPECT_TRUE(policy.plan().set_up);
  policy.factors_made();
  EXPECT_EQ(policy.judge({.residual = 1e-9, .branch = closed, .change = 1e-8}), Verdict::done);
}

// ---- the solver

/// x = b in three unknowns by factors that were made for D x: the error of component i contracts by
/// 1 - 1 / D_i.
struct Scaled {
  Structure structure;
  static constexpr double unit = 1e-5;  // of the residual: far below NewtonOptions::balance
  std::vector<double> rates, right;

  Scaled(std::vector<double> rates, std::vector<double> right)
      : rates(std::move(rates)), right(std::move(right)) {
    structure.size = 3;
    PatternBuilder builder(3);
    for (int i = 0; i < 3; ++i) builder.add({i}, {i});
    structure.pattern = builder.build();
    structure.group = {0, 1, 2};
    structure.differential = {1, 1, 1};
    structure.row_scale = structure.unknown_scale = {1, 1, 1};
  }
  NonlinearFunction function() const {
    NonlinearFunction function;
    function.residual = [this](std::span<const double> y, std::span<double> G) {
      for (int i = 0; i < 3; ++i) G[i] = unit * (y[i] - right[i]);
    };
    function.jacobian = [this](std::span<const double>, std::span<double> J) {
      for (int i = 0; i < 3; ++i) J[i] = unit / (1 - rates[i]);
    };
    function.distance = distance_of;
    return function;
  }
  static double distance_of(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / 3);
  }
  double distance(const std::vector<double>& y) const { return distance_of(y, right); }
};

TEST(TimeError, OfTheAcceptedIterateIsTheFractionForOneRate) {
  for (const double fraction : {1e-3, 0.02, 0.3}) {
    const Scaled problem({0.15, 0.15, 0.15}, {3, -1, 2});
    Counters counters;
    NewtonSolver newton(problem.structure, counters, options_with(fraction));
    std::vector<double> y(3);
    ASSERT_TRUE(newton.solve(problem.function(), y).converged);
    EXPECT_LE(problem.distance(y), fraction * (1 + 1e-9));
    EXPECT_GT(problem.distance(y), 0.15 * fraction);
  }
}

// Every component contracts by at least half the largest rate q, hence so do residual and steps in
// every norm of this kind; the distance is at most q / (1 - q) of the last step, the estimate at
// least that with q / 2.
TEST(TimeError, OfTheAcceptedIterateIsBoundedByTheSpreadOfTheRates) {
  constexpr double q = 0.18, bound = (q / (1 - q)) / ((q / 2) / (1 - q / 2));
  for (const double fraction : {1e-3, 0.02, 0.3})
    for (const auto& right : {std::vector<double>{1, 1, 1}, {1, 3, 10}, {10, 3, 1}}) {
      const Scaled problem({q, 0.75 * q, q / 2}, right);
      Counters counters;
      NewtonSolver newton(problem.structure, counters, options_with(fraction));
      std::vector<double> y(3);
      ASSERT_TRUE(newton.solve(problem.function(), y).converged);
      EXPECT_LE(problem.distance(y), bound * fraction);
    }
}

TEST(TimeError, TakesMoreIterationsForSmallerFractions) {
  int last = 0;
  for (const double fraction : {0.3, 0.1, 0.03, 0.01, 1e-3, 1e-5, 0.0}) {
    const Scaled problem({0.1, 0.15, 0.12}, {3, -1, 2});
    Counters counters;
    NewtonSolver newton(problem.structure, counters, options_with(fraction));
    std::vector<double> y(3);
    const int iterations = newton.solve(problem.function(), y).iterations;
    EXPECT_GE(iterations, last) << fraction;
    last = iterations;
  }
  EXPECT_GT(last, 5);
}

TEST(TimeError, WithoutADistanceEndsAtTheResidual) {
  const Scaled problem({0.1, 0.15, 0.12}, {3, -1, 2});
  NonlinearFunction function = problem.function();
  function.distance = {};
  Counters counters;
  NewtonSolver newton(problem.structure, counters, options_with(0.3));
  std::vector<double> y(3);
  const NewtonReport report = newton.solve(function, y);
  ASSERT_TRUE(report.converged);
  EXPECT_LE(report.norms.back(), 1e-11);
}

// Changes are those between iterates, from the guess of each solve.
TEST(TimeError, MeasuresTheStepsBetweenIterates) {
  const Scaled problem({0.1, 0.1, 0.1}, {3, -1, 2});
  NonlinearFunction function = problem.function();
  std::vector<double> sizes;
  function.distance = [&](std::span<const double> before, std::span<const double> y) {
    sizes.push_back(y[0] - before[0]);
    return 1.0;  // never small enough
  };
  Counters counters;
  NewtonSolver newton(problem.structure, counters, options_with(0.01));
  for (const double guess : {0.0, 2.0}) {
    sizes.clear();
    std::vector<double> y = {guess, 0, 0};
    const NewtonReport report = newton.solve(function, y);
    ASSERT_TRUE(report.converged);
    ASSERT_EQ(std::ssize(sizes), report.iterations);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sizes[k], 0.9 * (3 - guess) * std::pow(0.1, k), 1e-12) << k;
  }
}

}  // namespace
}  // namespace gnomon::time_error_test
