// The reduced Jacobian against finite differences of the reduced rate, with the contact problem and
// the mesh motion solved, and its largest eigenvalues against all of them.

#include <Eigen/Eigenvalues>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/stability/stability.hpp>

#include "support/derivatives.hpp"
#include "support/pin.hpp"
#include "support/problem_run.hpp"

namespace gnomon::reduced_jacobian_test {
namespace {

using namespace testing;

/// A worn state, whose accuracy does not matter.
PinRun worn_pin(int n, const Overrides& overrides = {}) {
  Overrides all = overrides;
  all.push_back(elements(n));
  return run_pin("backward-euler", 50, 0, 100, all);
}

class ReducedRate {
public:
  ReducedRate(const System& system, const State& at)
      : system_(system),
        at_(at),
        branch_(active_set(system, at.t, at.y)),
        stages_(system, counters_) {}

  /// With the differential component at position i of y moved by `change`.
  Eigen::VectorXd operator()(int i, double change, const std::vector<int>& components) {
    State state = at_;
    state.y[i] += change;
    const std::string reason = stages_.solve(state.t, state.y, &branch_);
    EXPECT_EQ(reason, "");
    set_rates(system_, &branch_, state);
    Eigen::VectorXd rate(components.size());
    for (std::size_t k = 0; k < components.size(); ++k) rate[k] = state.ydot[components[k]];
    return rate;
  }

private:
  const System& system_;
  State at_;
  ActiveSet branch_;
  Counters counters_;
  AlgebraicSolver stages_;
};

void expect_derivative_of_the_rate(const Overrides& overrides) {
  const PinRun pin = worn_pin(10, overrides);
  const ReducedJacobian G(pin.model->system(), pin.last());
  ReducedRate rate(pin.model->system(), pin.last());
  const double change = 1e-6;  // mm
  Eigen::MatrixXd differences(G.size(), G.size());
  for (int j = 0; j < G.size(); ++j) {
    const int i = G.components()[j];
    differences.col(j) =
        (rate(i, change, G.components()) - rate(i, -change, G.components())) / (2 * change);
  }
  // Not trivial: several nodes wear, and they are coupled with their neighbours.
  const Eigen::ArrayXXd size = differences.cwiseAbs().array() / differences.cwiseAbs().maxCoeff();
  ASSERT_GE((size.matrix().diagonal().array() > 0.1).count(), 3);
  ASSERT_GE((size > 0.01).count() - (size.matrix().diagonal().array() > 0.01).count(), 6);
  expect_same_matrix(G.dense(), differences, 1e-5);
}

TEST(ReducedJacobian, IsTheDerivativeOfTheReducedRate) {
  expect_derivative_of_the_rate({});
}

TEST(ReducedJacobian, IsItForOtherElementsNormalsAndConstraints) {
  expect_derivative_of_the_rate({"body.element=plain", "wear.normal=normalised"});
  expect_derivative_of_the_rate({"body.element=f-bar-variational", "shape.constraint=multiplier"});
}

// On springs every redistribution of the pressure decays at the rate K_w k v; the load fixes the
// mean.
TEST(ReducedJacobian, HasTheSpectrumOfTheSprings) {
  const Scene scene = load_scene(GNOMON_SOURCE_DIR "/problems/winkler/pin.toml",
                                 {"foundation.points=81"}, key_table);
  const auto model = Problems::find("winkler", "problem").make(scene);
  Counters counters;
  const State start = model->start(counters);
  const double rate = scene.real("foundation.modulus") * scene.real("wear.coefficient") *
                      scene.real("wear.velocity");
  const ReducedJacobian G(model->system(), start);
  const ActiveSet branch = active_set(model->system(), start.t, start.y);
  const auto closed = std::count(branch.begin(), branch.end(), 1);
  ASSERT_GT(closed, 10);
  ASSERT_LT(closed, G.size());
  const std::vector<Mode> modes = all_modes(G.dense());
  for (int k = 0; k < G.size(); ++k)
    EXPECT_LT(std::abs(modes[k].eigenvalue - (k < closed - 1 ? -rate : 0.0)), 1e-9 * rate) << k;
  for (const Mode& mode : leading_modes(G, 6))
    EXPECT_LT(std::abs(mode.eigenvalue + rate), 1e-8 * rate);
}

TEST(LeadingModes, AreThoseOfTheWholeSpectrum) {
  const PinRun pin = worn_pin(20);
  const ReducedJacobian G(pin.model->system(), pin.last());
  constexpr int count = 5;
  ASSERT_GT(G.size(), 4 * count + 10) << "too small for the Arnoldi iteration";
  const Eigen::MatrixXd dense = G.dense();
  const std::vector<Mode> all = all_modes(dense), leading = leading_modes(G, count);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(G.size()));
  ASSERT_EQ(leading.size(), static_cast<std::size_t>(count));
  const double largest = std::abs(all[0].eigenvalue);
  ASSERT_GT(largest, 0);
  for (int k = 0; k < count; ++k) {
    EXPECT_LT(std::abs(leading[k].eigenvalue - all[k].eigenvalue), 1e-8 * largest) << k;
    const Eigen::VectorXcd v = leading[k].direction;
    EXPECT_LT((dense * v - leading[k].eigenvalue * v).norm(), 1e-7 * largest) << k;
    EXPECT_NEAR(v.norm(), 1, 1e-12);
  }
}

TEST(LeadingModes, OfASmallMatrixAreFoundDirectly) {
  const PinRun pin = worn_pin(8);
  const ReducedJacobian G(pin.model->system(), pin.last());
  const std::vector<Mode> all = all_modes(G.dense());
  const std::vector<Mode> leading = leading_modes(G, 6);
  ASSERT_EQ(leading.size(), 6u);
  EXPECT_EQ(leading[0].eigenvalue, all[0].eigenvalue);
  EXPECT_EQ(leading_modes(G, 1000).size(), all.size());
}

// Wear by friction, without friction: G = 0 (and large enough for the Arnoldi iteration).
TEST(LeadingModes, ThereAreNoneWhereNothingWears) {
  const auto ball = model_of("ball_on_flat/small_deformation.toml",
                             {"mesh.elements=[4, 2, 3]", "friction.coefficient=0"});
  Counters counters;
  const ReducedJacobian G(ball->system(), ball->start(counters));
  ASSERT_GT(G.size(), 20) << "too small for the Arnoldi iteration";
  EXPECT_TRUE(leading_modes(G, 1).empty());
}

}  // namespace
}  // namespace gnomon::reduced_jacobian_test
