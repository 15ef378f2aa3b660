// The equations of nodes that slide along oblique planes: derivatives, symmetry, and what is lost.

#include <Eigen/Eigenvalues>
#include <gnomon/system/system.hpp>

#include "part/tapered_parts.hpp"

namespace gnomon::oblique_equations_test {
namespace {

using namespace testing;

using ObliqueEquations = TaperedParts;

/// At every instant: the derivative of the worn volume along ydot is the flux, whatever the state.
void expect_balance(const Model& model) {
  const State state = run_model(model, "esdirk-3", 0, 1e-3, end, false, to_rounding).last();
  const auto volume = [&](double time) {
    State moved = state;
    for (std::size_t i = 0; i < moved.y.size(); ++i) moved.y[i] += time * moved.ydot[i];
    return observed(model, moved, "worn_volume");
  };
  // Exact for cubic polynomials in the time, which the volume is.
  const double h = 100;
  const double rate = (8 * (volume(h) - volume(-h)) - (volume(2 * h) - volume(-2 * h))) / (12 * h);
  EXPECT_NEAR(rate / observed(model, state, "wear_flux"), 1, 1e-11);
}

TEST_F(ObliqueEquations, WhatWearsIsLostAtEveryInstant) {
  const std::string soft = "body.young_modulus=1e3", rubs = "friction.coefficient=0.3";
  expect_balance(*tapered({soft, rubs}));
  expect_balance(*cone({soft}));
  expect_balance(*pyramid({soft, rubs}));
}

/// At a state that the equations of the sides do not hold either.
void expect_jacobian(const Model& model) {
  Counters counters;
  std::vector<double> y = model.start(counters).y;
  const Structure& structure = model.system().structure();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.02 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  check_jacobian(model.system(), 0, y, 0.2, nullptr, 1e-4);
  for (const AlgebraicStage& stage : model.system().algebraic_stages()) {
    stage.freeze(0, y);
    std::vector<double> part;
    for (int unknown : stage.unknowns) part.push_back(y[unknown]);
    check_jacobian(*stage.system, 0, part, 0, nullptr, 1e-4);
  }
}

// Solvers by blocks rely on it.
TEST_F(ObliqueEquations, TheMatrixOfTheMeshMotionIsSymmetric) {
  const auto pin = pyramid();
  Counters counters;
  const State start = pin->start(counters);
  const auto stages = pin->system().algebraic_stages();
  const System& motion = *stages.front().system;
  const SparsePattern& pattern = motion.structure().pattern;
  std::vector<double> y(motion.structure().size), values(pattern.nonzeros());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.02 * std::sin(1.0 + 7.0 * double(i));
  stages.front().freeze(0, start.y);
  motion.jacobian({.t = 0, .y = y}, 0, values);
  const Eigen::MatrixXd K = dense(pattern, values);
  EXPECT_LE((K - K.transpose()).norm(), 1e-13 * K.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(K, Eigen::EigenvaluesOnly);
  EXPECT_GT(spectrum.eigenvalues()[0], 1e-3 * spectrum.eigenvalues().tail<1>()[0]);
}

TEST_F(ObliqueEquations, JacobianEqualsFiniteDifferences) {
  for (const char* constraint : {"eliminated", "multiplier"}) {
    const Overrides form = {fmt::format("shape.constraint={}", constraint),
                            "body.young_modulus=1e3"};
    expect_jacobian(*tapered(form));
    expect_jacobian(*cone(form));
    expect_jacobian(*pyramid(form, 2));
  }
}

}  // namespace
}  // namespace gnomon::oblique_equations_test
