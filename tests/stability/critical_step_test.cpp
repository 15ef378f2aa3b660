// Stability regions of known methods, and the steps that they allow.

#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/stability/stability.hpp>

namespace gnomon::critical_step_test {
namespace {

using Complex = std::complex<double>;
constexpr double real_axis = M_PI, imaginary_axis = M_PI / 2;

ButcherTable table_of(const std::string& name) {
  return Integrators::find(name, "integrator").table({}).value();
}

ButcherTable classical() {
  ButcherTable table{
      "Kutta", 4, Eigen::MatrixXd::Zero(4, 4), Eigen::VectorXd(4), Eigen::VectorXd(4), 0, {}};
  table.A(1, 0) = table.A(2, 1) = 0.5;
  table.A(3, 2) = 1;
  table.b << 1. / 6, 1. / 3, 1. / 3, 1. / 6;
  table.c << 0, 0.5, 0.5, 1;
  return table;
}

/// 1 + z + ... + z^p / p!, all there is for p stages of order p.
Complex truncated_exponential(Complex z, int p) {
  Complex sum = 1, term = 1;
  for (int k = 1; k <= p; ++k) sum += term *= z / double(k);
  return sum;
}

std::vector<Mode> modes(const std::vector<Complex>& eigenvalues) {
  std::vector<Mode> result;
  for (Complex value : eigenvalues) result.push_back({value, Eigen::VectorXcd::Ones(1)});
  return result;
}

TEST(StabilityFunction, IsTheTruncatedExponentialWhereStagesEqualOrder) {
  for (Complex z : {Complex(-1.3, 0), Complex(-0.4, 2.1), Complex(0.7, -0.2)}) {
    EXPECT_LT(std::abs(stability_function(table_of("forward-euler"), z) - (1.0 + z)), 1e-14);
    EXPECT_LT(std::abs(stability_function(classical(), z) - truncated_exponential(z, 4)), 1e-13);
    EXPECT_LT(std::abs(stability_function(table_of("backward-euler"), z) - 1.0 / (1.0 - z)), 1e-14);
  }
}

TEST(StabilityBoundary, IsThatOfKnownMethods) {
  EXPECT_NEAR(stability_boundary(table_of("forward-euler"), real_axis), 2, 1e-9);
  EXPECT_NEAR(stability_boundary(table_of("erk-2"), real_axis), 2, 1e-9);
  // Three stages of order three; the fourth stage of Bogacki and Shampine is only for the estimate.
  EXPECT_NEAR(stability_boundary(table_of("erk-3"), real_axis), 2.512745, 1e-6);
  EXPECT_NEAR(stability_boundary(classical(), real_axis), 2.785294, 1e-6);
  EXPECT_NEAR(stability_boundary(classical(), imaginary_axis), 2 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(stability_boundary(table_of("forward-euler"), imaginary_axis), 0);
  // |1 + z| <= 1 at an angle: chords of the unit circle around -1.
  EXPECT_NEAR(stability_boundary(table_of("forward-euler"), 0.75 * M_PI), std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(std::isinf(stability_boundary(table_of("backward-euler"), real_axis)));
}

// Five stages of order four, the fifth only for the estimate: the boundary is that of the
// polynomial with coefficients b^T A^k 1, which is the classical one.
TEST(StabilityBoundary, OfZonneveldIsThatOfItsPolynomial) {
  const ButcherTable table = table_of("erk-4");
  std::vector<double> coefficients = {1};
  for (Eigen::VectorXd v = Eigen::VectorXd::Ones(5); coefficients.size() < 6; v = table.A * v)
    coefficients.push_back(table.b.dot(v));
  double factorial = 1;
  for (int k = 1; k <= 4; ++k) {
    factorial *= k;
    EXPECT_NEAR(coefficients[k], 1 / factorial, 1e-13);
  }
  const auto polynomial = [&](double x) {
    double sum = 0;
    for (int k = 5; k >= 0; --k) sum = sum * x + coefficients[k];
    return sum;
  };
  const double boundary = stability_boundary(table, real_axis);
  EXPECT_NEAR(coefficients[5], 0, 1e-15);
  EXPECT_NEAR(boundary, 2.785294, 1e-6);
  EXPECT_NEAR(std::abs(polynomial(-boundary)), 1, 1e-9);
  EXPECT_GT(std::abs(polynomial(-boundary - 1e-3)), 1);
  for (double x = 0.01; x < boundary; x += 0.01) EXPECT_LE(std::abs(polynomial(-x)), 1);
}

TEST(Explicit, IsToldFromTheTable) {
  EXPECT_TRUE(is_explicit(table_of("forward-euler")));
  EXPECT_TRUE(is_explicit(classical()));
  EXPECT_FALSE(is_explicit(table_of("backward-euler")));
  EXPECT_FALSE(is_explicit(table_of("theta")));
  EXPECT_FALSE(is_explicit(table_of("esdirk-4")));
}

TEST(CriticalStep, IsSetByTheModeThatBearsLeast) {
  const ButcherTable euler = table_of("forward-euler");
  const CriticalStep real = critical_step(euler, modes({-0.5, -0.4, -0.1}));
  EXPECT_NEAR(real.step, 4, 1e-9);
  EXPECT_EQ(real.mode, 0);
  // -2 Re / |lambda|^2: a smaller but oscillating mode has a smaller critical step.
  const CriticalStep complex = critical_step(euler, modes({-0.5, {-0.1, 0.4}, {-0.1, -0.4}}));
  EXPECT_NEAR(complex.step, 0.2 / 0.17, 1e-9);
  EXPECT_EQ(complex.mode, 1);
}

TEST(CriticalStep, CountsUndampedOscillations) {
  const std::vector<Mode> oscillation = modes({{0, 2}, {0, -2}});
  EXPECT_EQ(critical_step(table_of("forward-euler"), oscillation).step, 0);
  EXPECT_NEAR(critical_step(table_of("erk-4"), oscillation).step, std::sqrt(2.0), 1e-6);
}

TEST(CriticalStep, AsksNothingOfGrowingAndOfSlowModes) {
  const ButcherTable euler = table_of("forward-euler");
  const std::vector<Mode> spectrum = modes({-0.5, {0.1, 0.2}, {0.1, -0.2}, {-1e-6, 1e-3}, 0});
  EXPECT_NEAR(critical_step(euler, spectrum).step, 4, 1e-9);
  EXPECT_EQ(critical_step(euler, modes({0.1, 0.05})).mode, -1);
  EXPECT_TRUE(std::isinf(critical_step(euler, {}).step));
  EXPECT_EQ(critical_step(table_of("backward-euler"), spectrum).mode, -1);
}

}  // namespace
}  // namespace gnomon::critical_step_test
