// Real steps of every integrator of the registry on problems with exact solutions.

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <gnomon/system/system.hpp>

#include "support/problem_run.hpp"

namespace gnomon::registry_test {
namespace {

using namespace testing;
using Complex = std::complex<double>;

class Every : public ::testing::TestWithParam<std::string> {};

/// The state of ydot = z y, y(0) = 1 after one step of size 1. Without forcing the two differential
/// components are the real and the imaginary part of y.
Complex one_step(const std::string& integrator, Complex z) {
  const auto model =
      model_of("dahlquist/decay.toml", {fmt::format("dahlquist.rate_real={:.17g}", z.real()),
                                        fmt::format("dahlquist.rate_imag={:.17g}", z.imag())});
  const ModelRun run = run_model(*model, integrator, 1, 1e-4, 1);
  EXPECT_EQ(run.counters.steps, 1);
  std::vector<double> y;
  for (std::size_t i = 0; i < run.last().y.size(); ++i)
    if (model->system().structure().differential[i]) y.push_back(run.last().y[i]);
  return {y.at(0), y.at(1)};
}

/// R(z) = det(I - z A + z 1 b^T) / det(I - z A).
Complex rational(const ButcherTable& table, Complex z) {
  const auto n = table.stages();
  const Eigen::MatrixXcd A = table.A.cast<Complex>();
  const Eigen::MatrixXcd D = Eigen::MatrixXcd::Identity(n, n) - z * A;
  const Eigen::MatrixXcd N =
      D + z * Eigen::VectorXcd::Ones(n) * table.b.transpose().cast<Complex>();
  return N.determinant() / D.determinant();
}

TEST_P(Every, StepsTheTestEquationByItsRationalFunction) {
  const auto table = Integrators::find(GetParam(), "integrator").table(IntegratorSettings{});
  if (!table) GTEST_SKIP() << "not a one-step method";
  for (const Complex z : {Complex(-0.3, 0), Complex(-2, 1), Complex(0, 1.5), Complex(-20, 5)}) {
    const Complex R = rational(*table, z);
    EXPECT_LT(std::abs(one_step(GetParam(), z) - R), 1e-9 * std::max(1.0, std::abs(R))) << z;
  }
}

TEST_P(Every, ShowsItsOrderOnASmoothProblem) {
  const auto table = Integrators::find(GetParam(), "integrator").table(IntegratorSettings{});
  if (!table) GTEST_SKIP() << "chooses its own steps";
  const auto model = model_of("dahlquist/nonlinear.toml");
  // Small enough for the leading term, large enough to stay above the solves' tolerance.
  const double step = table->order >= 4 ? 0.05 : 0.01;
  const auto error = [&](double h) {
    return error_of(*model, run_model(*model, GetParam(), h, 1e-4, 2).last());
  };
  const double coarse = error(step), fine = error(step / 2);
  EXPECT_GT(fine, 1e-11);
  EXPECT_NEAR(std::log2(coarse / fine), table->order, 0.2);
}

TEST_P(Every, FollowsTheTolerance) {
  const auto model = model_of("dahlquist/nonlinear.toml");
  long steps = 0;
  double last = 1;
  for (double rtol : {1e-3, 1e-5, 1e-7}) {
    if (rtol < 1e-6 && Integrators::find(GetParam(), "integrator").order[0] == '1' &&
        GetParam() != "bdf")
      continue;  // first-order methods would take millions of steps
    const ModelRun run = run_model(*model, GetParam(), 0, rtol, 2);
    const double error = error_of(*model, run.last());
    EXPECT_LT(error, last / 3) << rtol;
    EXPECT_LT(error, 1000 * rtol) << rtol;  // errors of the steps add up
    EXPECT_GT(run.counters.steps, steps);
    steps = run.counters.steps;
    last = error;
  }
}

std::vector<std::string> all_names() {
  return Integrators::names();
}

std::string parameter_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Every, ::testing::ValuesIn(all_names()), parameter_name);

}  // namespace
}  // namespace gnomon::registry_test
