#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/model/wear_model.hpp>

#include "support/problem_run.hpp"

namespace gnomon::flat_punch_test {
namespace {

using namespace testing;

constexpr double F = 2, a = 1, k_v = 1e-4, E_star = 2000 / (1 - 0.3 * 0.3);

std::unique_ptr<Model> block(double width, int under, Overrides overrides = {}) {
  overrides.push_back("block.width=" + std::to_string(width));
  overrides.push_back("block.depth=" + std::to_string(width / 2));
  overrides.push_back("mesh.punch_elements=" + std::to_string(under));
  return model_of("flat_punch/half_plane.toml", overrides);
}

/// The reduced Jacobian G = d(rate)/d(d) over the differential components: the block of J^-1 there
/// is (alpha I - G)^-1.
Eigen::MatrixXd reduced_jacobian(const System& system, const State& state, double alpha) {
  const Structure& structure = system.structure();
  std::vector<int> worn;
  for (int i = 0; i < structure.size; ++i)
    if (structure.differential[i]) worn.push_back(i);
  std::vector<double> values(structure.pattern.nonzeros());
  system.jacobian({state.t, state.y, state.ydot}, alpha, values);
  SparseLu lu(structure.pattern, structure.group);
  EXPECT_TRUE(lu.factorize(values));
  const auto n = static_cast<Eigen::Index>(worn.size());
  Eigen::MatrixXd inverse(n, n);
  std::vector<double> b(structure.size), x(structure.size);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::fill(b.begin(), b.end(), 0.0);
    b[worn[j]] = 1;
    lu.solve(b, x);
    for (Eigen::Index i = 0; i < n; ++i) inverse(i, j) = x[worn[i]];
  }
  return alpha * Eigen::MatrixXd::Identity(n, n) - inverse.inverse();
}

/// The slowest decay rates in units of E* k v/a, ascending; without those that are zero (the mean
/// depth and the lateral shape, on which the rate does not depend).
std::vector<double> decay_rates(const Model& model) {
  Counters counters;
  const State state = model.start(counters);
  const double unit = E_star * k_v / a;
  const auto values = reduced_jacobian(model.system(), state, unit).eigenvalues();
  std::vector<double> rates;
  for (const auto& value : values)
    if (-value.real() > 0.05 * unit) rates.push_back(-value.real() / unit);
  std::sort(rates.begin(), rates.end());
  return rates;
}

/// c_n of the integral equation (flat_punch.cpp), with piecewise constant pressure on a mesh graded
/// towards the edges: a reference that is independent of the finite elements.
std::vector<double> half_plane_rates() {
  constexpr int n = 600;
  Eigen::VectorXd edge(n + 1), x(n), w(n);
  for (int k = 0; k <= n; ++k) edge[k] = -std::cos(M_PI * k / n);
  for (int k = 0; k < n; ++k) x[k] = (edge[k] + edge[k + 1]) / 2, w[k] = edge[k + 1] - edge[k];
  const auto primitive = [](double z) { return z == 0 ? 0 : z * std::log(std::abs(z)) - z; };
  Eigen::MatrixXd K(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) K(i, j) = primitive(edge[j] - x[i]) - primitive(edge[j + 1] - x[i]);
  const Eigen::MatrixXd P =
      Eigen::MatrixXd::Identity(n, n) - Eigen::VectorXd::Ones(n) * w.transpose() / 2;
  std::vector<double> rates;
  for (const auto& mu : (P * K * P).eigenvalues())
    if (mu.real() > 0.1) rates.push_back(M_PI / (2 * mu.real()));
  std::sort(rates.begin(), rates.end());
  return rates;
}

const double c[] = {1.0031, 1.7267, 2.5627, 3.3143, 4.1300};

TEST(FlatPunch, RatesOfTheHalfPlaneComeFromItsIntegralEquation) {
  const std::vector<double> rates = half_plane_rates();
  ASSERT_GE(rates.size(), 5u);
  for (int n = 0; n < 5; ++n) EXPECT_NEAR(rates[n], c[n], 2e-3 * c[n]) << n;
}

double deviation(const std::vector<double>& rates, int n) {
  return rates.at(n) / c[n] - 1;
}

// The finite width of the block changes the first mode most, the mesh changes the higher ones; both
// errors tend to zero.
TEST(FlatPunch, DecayRatesTendToTheHalfPlane) {
  const auto with_width = [](double width) { return decay_rates(*block(width, 20)); };
  const auto narrow = with_width(10), wide = with_width(20), wider = with_width(40);
  for (int n = 0; n < 5; ++n)
    std::printf("c_%d = %.4f; block 10 a, 20 a, 40 a wide: %.4f %.4f %.4f\n", n + 1, c[n],
                narrow[n], wide[n], wider[n]);
  EXPECT_NEAR(deviation(narrow, 0) / deviation(wide, 0), 4, 0.8);
  EXPECT_NEAR(deviation(wide, 0) / deviation(wider, 0), 4, 0.8);
  EXPECT_NEAR(deviation(wider, 0), 0, 0.01);

  const auto coarse = decay_rates(*block(40, 10)), fine = decay_rates(*block(40, 40));
  for (int n = 0; n < 5; ++n)
    std::printf("c_%d = %.4f; 10, 20, 40 elements under the punch: %.4f %.4f %.4f\n", n + 1, c[n],
                coarse[n], wider[n], fine[n]);
  for (int n = 1; n < 5; ++n) {
    EXPECT_LT(std::abs(deviation(wider, n)), 0.4 * std::abs(deviation(coarse, n))) << n;
    EXPECT_LT(std::abs(deviation(fine, n)), 0.4 * std::abs(deviation(wider, n))) << n;
    EXPECT_NEAR(deviation(fine, n), 0, 0.02) << n;
  }
}

std::vector<double> pressures(const Model& model, const State& state) {
  return model.contact(state)->pressure;
}

TEST(FlatPunch, PressureOfARigidPunchBecomesUniform) {
  const auto model = block(40, 20);
  const ModelRun run = run_model(*model, "esdirk-4", 0, 1e-4, 40);
  // Boussinesq's punch at the start, away from the edges: p = F/(pi sqrt(a^2 - x^2)).
  const ContactSurface start = model->contact(run.states.front()).value();
  ASSERT_EQ(start.node.size(), 21u);
  for (std::size_t i = 4; i <= 16; ++i) {
    const double x = start.initial[i][0];
    EXPECT_NEAR(start.pressure[i], F / (M_PI * std::sqrt(a * a - x * x)), 0.015 * F);
  }
  EXPECT_GT(start.pressure.front(), F / a);
  for (double pressure : pressures(*model, run.last()))
    EXPECT_NEAR(pressure, F / (2 * a), 1e-3 * F);
}

TEST(FlatPunch, NothingSwitchesAndForceAndFluxHold) {
  for (const char* scene : {"flat_punch/half_plane.toml", "flat_punch/small_block.toml"}) {
    const auto model = model_of(scene);
    const ModelRun run = run_model(*model, "bdf", 0, 1e-4, 20, false, to_rounding);
    for (const State& state : run.states) {
      const ContactSurface surface = model->contact(state).value();
      EXPECT_EQ(std::count(surface.active.begin(), surface.active.end(), 0), 0);
      EXPECT_NEAR(observed(*model, state, "contact_force"), F, 1e-8 * F);
      EXPECT_NEAR(observed(*model, state, "wear_flux"), k_v * F, 1e-8 * k_v * F);
    }
  }
}

// The pressure of a run decays as the reduced Jacobian predicts: the slowest symmetric mode is the
// second.
TEST(FlatPunch, ARunDecaysAtTheRateOfTheReducedJacobian) {
  const auto model = block(20, 10);
  const double rate = decay_rates(*model)[1] * E_star * k_v / a;
  const auto excess = [&](double end) {
    const State state = run_model(*model, "esdirk-4", 0, 1e-8, end).last();
    return pressures(*model, state)[5] - F / (2 * a);
  };
  const double from = excess(16), to = excess(20);
  EXPECT_LT(from, 0);  // too little in the middle
  EXPECT_NEAR(std::log(from / to) / 4, rate, 0.01 * rate);
}

/// Methods with fixed steps of 0.5 and 0.25 s to 4 s show their order, within `margin`.
void expect_orders(const Model& model, double margin) {
  const double end = 4;
  const State exact = run_model(model, "esdirk-5", 0.0625, 0, end).last();
  const auto& differential = model.system().structure().differential;
  const auto error = [&](const char* integrator, double step) {
    const State state = run_model(model, integrator, step, 0, end).last();
    double sum = 0;
    for (std::size_t i = 0; i < state.y.size(); ++i)
      if (differential[i]) sum += std::pow(state.y[i] - exact.y[i], 2);
    return std::sqrt(sum);
  };
  const std::pair<const char*, double> expected[] = {
      {"forward-euler", 1}, {"backward-euler", 1}, {"theta", 2}, {"esdirk-4", 4}, {"esdirk-5", 5}};
  for (const auto& [name, order] : expected) {
    const double coarse = error(name, 0.5), fine = error(name, 0.25);
    std::printf("%s: %.2e %.2e, order %.2f\n", name, coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(std::log2(coarse / fine), order - margin) << name;
    EXPECT_LT(std::log2(coarse / fine), order + margin) << name;
  }
}

// Without events every method shows its order. (Of esdirk-3 the terms of third and fourth order
// cancel between these steps; its order is tested on dahlquist.)
TEST(FlatPunch, FixedStepsShowTheOrder) {
  expect_orders(*model_of("flat_punch/small_block.toml"), 0.3);
}

// The load enters at the times of the stages, and no step crosses its breakpoints, which are not on
// the grid of the steps; a step across a breakpoint would reduce the order to two. (Under a falling
// load the edges, which are worn most, would lose contact.)
TEST(FlatPunch, FixedStepsShowTheOrderUnderARisingLoad) {
  expect_orders(*model_of("flat_punch/small_block.toml",
                          {"load.times=[0.6, 1.9, 2.8]", "load.factors=[1, 1.8, 2.1]"}),
                0.4);
}

TEST(FlatPunch, BdfAgreesUnderARisingLoad) {
  const auto model = model_of("flat_punch/small_block.toml",
                              {"load.times=[0.6, 1.9, 2.8]", "load.factors=[1, 1.8, 2.1]"});
  const auto depth = [&](const char* integrator) {
    const auto depths =
        model->contact(run_model(*model, integrator, 0, 1e-8, 4).last())->wear_depth;
    return Eigen::Map<const Eigen::VectorXd>(depths.data(), long(depths.size())).eval();
  };
  const Eigen::VectorXd esdirk = depth("esdirk-5");
  EXPECT_LT((depth("bdf") - esdirk).norm(), 1e-6 * esdirk.norm());
}

TEST(FlatPunch, JacobianEqualsCentralDifferences) {
  const auto model =
      model_of("flat_punch/small_block.toml", {"mesh.punch_elements=2", "mesh.grading=2.5"});
  const System& system = model->system();
  Counters counters;
  State state = model->start(counters);
  for (std::size_t i = 0; i < state.y.size(); ++i) state.y[i] += 0.002 * std::sin(double(3 * i));
  const ActiveSet closed(system.structure().switch_node.size(), 1);
  check_jacobian(system, 0, state.y, 0.2, &closed);
}

TEST(FlatPunch, RefusesABlockNarrowerThanThePunch) {
  EXPECT_THROW(model_of("flat_punch/small_block.toml", {"block.width=1.5"}), InputError);
}

TEST(FlatPunch, WearsToAUniformPressureByEveryRuleOfNormals) {
  for (const Overrides& rule : {Overrides{"wear.normal=averaged"},
                                {"wear.normal=normalised"},
                                {"wear.normal=conservative"},
                                {"wear.normal=conservative", "shape.motion=gap"}}) {
    const auto model = model_of("flat_punch/small_block.toml", rule);
    const State end = run_model(*model, "esdirk-4", 0, 1e-5, 20).last();
    const ContactSurface surface = *model->contact(end);
    for (const double pressure : surface.pressure)
      EXPECT_NEAR(pressure, F / (2 * a), 0.02) << rule.back();
  }
}

}  // namespace
}  // namespace gnomon::flat_punch_test
