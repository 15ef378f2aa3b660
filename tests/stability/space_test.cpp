// The reduced Jacobian in space: its products by blocks against one factorization of the whole
// Jacobian, and the work that they take.

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/stability/stability.hpp>

#include "ball/coarse.hpp"

namespace gnomon::space_test {
namespace {

using namespace testing;

constexpr int stages = 2;  // mesh motion, contact

/// G by LU factors of J with the identity in the differential rows.
Eigen::MatrixXd by_factors_of_the_whole(const System& system, const State& state) {
  const Structure& structure = system.structure();
  const SparsePattern& pattern = structure.pattern;
  const ActiveSet branch = active_set(system, state.t, state.y);
  std::vector<double> J(pattern.nonzeros()), left(J.size());
  system.jacobian({state.t, state.y, state.ydot, &branch}, 0, J);
  std::vector<int> components;
  for (int i = 0; i < pattern.size(); ++i)
    if (structure.differential[i]) components.push_back(i);
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int i = pattern.row_index[k];
      left[k] = !structure.differential[i] ? J[k] : i == j ? 1 : 0;
    }
  SparseLu lu(pattern, structure.group);
  EXPECT_TRUE(lu.factorize(left));
  const auto count = static_cast<Eigen::Index>(components.size());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(count, count);
  std::vector<int> number(pattern.size(), -1);
  for (int k = 0; k < count; ++k) number[components[k]] = k;
  for (int c = 0; c < count; ++c) {
    std::vector<double> unit(pattern.size()), change(pattern.size());
    unit[components[c]] = 1;
    lu.solve(unit, change);
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        if (const int row = number[pattern.row_index[k]]; row >= 0) G(row, c) -= J[k] * change[j];
  }
  return G;
}

struct Case {
  const char *name, *scene;
  Overrides mesh;
  double step;  // of the two that lead to the state [s]
  const char* preconditioner;
};

class InSpace : public ::testing::TestWithParam<Case> {};

TEST_P(InSpace, ModesAreThoseOfTheWholeJacobian) {
  const Case& c = GetParam();
  const std::string solver = "solver.preconditioner=\"" + std::string(c.preconditioner) + "\"";
  const auto model = model_of(c.scene, c.mesh + Overrides{solver});
  const State state =
      run_model(*model, "backward-euler", c.step, 1e-4, 2 * c.step, false, to_rounding).last();
  const ReducedJacobian G(model->system(), state);
  constexpr int count = 3;
  ASSERT_GT(G.size(), 20) << "too small for the Arnoldi iteration";
  const Eigen::MatrixXd whole = by_factors_of_the_whole(model->system(), state);
  const std::vector<Mode> all = all_modes(whole), leading = leading_modes(G, count);
  const double largest = std::abs(all.front().eigenvalue);
  ASSERT_GT(largest, 0);
  ASSERT_EQ(leading.size(), static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    EXPECT_NEAR(std::abs(leading[k].eigenvalue), std::abs(all[k].eigenvalue), 1e-7 * largest) << k;
    const Eigen::VectorXcd& v = leading[k].direction;
    EXPECT_LT((whole * v - leading[k].eigenvalue * v).norm(), 1e-7 * largest) << k;
  }
}

// Factors of the whole Jacobian would count as a factorization.
TEST_P(InSpace, TheWholeJacobianIsNeverFactorized) {
  const Case& c = GetParam();
  const std::string preconditioner = c.preconditioner;
  const auto model =
      model_of(c.scene, c.mesh + Overrides{"solver.preconditioner=\"" + preconditioner + "\""});
  Counters counters;
  const ReducedJacobian G(model->system(), model->start(counters));
  EXPECT_EQ(G.counters().preconditioner_setups, stages);
  const auto n = static_cast<std::size_t>(G.size());
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(G.size(), -1, 2);
  Eigen::VectorXd Gv(G.size());
  constexpr int products = 3;
  for (int k = 0; k < products; ++k) G.multiply({v.data(), n}, {Gv.data(), n});
  EXPECT_GT(Gv.norm(), 0);
  EXPECT_EQ(G.counters().jacobian_evaluations, 1);
  EXPECT_EQ(G.counters().preconditioner_setups, stages);
  EXPECT_EQ(G.counters().factorizations, preconditioner == "multigrid" ? 0 : stages);
  // From 1 to 1e-6, on to 1e-10, and now and then a little further.
  EXPECT_LE(G.counters().linear_solves, 3 * stages * products);
}

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const char* preconditioner : {"factor", "multigrid"}) {
    if (preconditioner == std::string("multigrid") && !has_multigrid()) continue;
    result.push_back({"ball", ball_finite, ball_mesh(4, 2, 3), 50, preconditioner});
    result.push_back({"groove", groove_small, block_mesh(6, 20, 4, 0.06), 20, preconditioner});
    result.push_back({"deep_groove", groove_finite, block_mesh(6, 14, 4, 0.5), 50, preconditioner});
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Scenes, InSpace, ::testing::ValuesIn(cases()), [](const auto& info) {
  return std::string(info.param.name) + "_" + info.param.preconditioner;
});

}  // namespace
}  // namespace gnomon::space_test
