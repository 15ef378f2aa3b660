// The solvers of K_uu against dense ones.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <gnomon/linear/inner_solver.hpp>

#include "linear/spring_update.hpp"

namespace gnomon {
namespace {

/// A chain of nodes with three unknowns each: every node is coupled with the next.
struct Chain {
  static constexpr int nodes = 40, size = 3 * nodes;
  StiffnessLayout layout;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  std::vector<double> values;

  /// Stiffness a^T a of random differences between neighbours, and a little ground.
  Chain() {
    std::srand(7);
    for (int node = 0; node + 1 < nodes; ++node) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::Random(6, 6);
      K.block<6, 6>(3 * node, 3 * node) += a.transpose() * a;
    }
    K.diagonal().array() += 0.1;
    PatternBuilder builder(size);
    for (int j = 0; j < size; ++j)
      for (int i = j; i < std::min(size, 3 * (j / 3) + 6); ++i) builder.add({i}, {j});
    layout.lower = builder.build();
    for (int i = 0; i < size; ++i) layout.group.push_back(i / 3);
    gather();
  }
  void gather() {
    values.clear();
    for (int j = 0; j < size; ++j)
      for (int k = layout.lower.column_start[j]; k < layout.lower.column_start[j + 1]; ++k)
        values.push_back(K(layout.lower.row_index[k], j));
  }
};

TEST(FactorSolver, SolvesManyColumnsAtOnce) {
  const Chain chain;
  const auto solver = make_factor_solver(chain.layout);
  ASSERT_TRUE(solver->set_up(chain.values));
  EXPECT_EQ(solver->factorizations(), 1);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(Chain::size, 70);  // more than it takes at once
  Eigen::MatrixXd X(B.rows(), B.cols());
  solver->apply({B.data(), static_cast<std::size_t>(B.size())},
                {X.data(), static_cast<std::size_t>(X.size())});
  EXPECT_LT((chain.K * X - B).norm(), 1e-10 * B.norm());
}

TEST(FactorSolver, RaisesTheDiagonalOfAnIndefiniteMatrix) {
  Chain chain;
  const double least = chain.K.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  chain.K.diagonal().array() -= least + 0.002 * chain.K.diagonal().minCoeff();
  ASSERT_LT(chain.K.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  chain.gather();
  const auto solver = make_factor_solver(chain.layout);
  ASSERT_TRUE(solver->set_up(chain.values));
  EXPECT_GT(solver->factorizations(), 1);
  Eigen::MatrixXd raised;
  double closest = 1;
  const Eigen::VectorXd b = Eigen::VectorXd::Random(Chain::size);
  Eigen::VectorXd x(Chain::size);
  solver->apply({b.data(), Chain::size}, {x.data(), Chain::size});
  for (const double by : {0.01, 0.1, 1.0}) {
    raised = chain.K;
    raised.diagonal() += by * chain.K.diagonal().cwiseAbs();
    closest = std::min(closest, (raised * x - b).norm() / b.norm());
  }
  EXPECT_LT(closest, 1e-10);
}

TEST(SpringUpdate, IsTheInverseWithTheChangedSprings) {
  const Chain chain;
  const auto solver = make_factor_solver(chain.layout);
  ASSERT_TRUE(solver->set_up(chain.values));
  SpringUpdate update;
  Eigen::MatrixXd changed = chain.K;
  Eigen::VectorXd k(3);
  k << 50, 0, -0.03;  // a new spring, one that is back, one that is softer
  std::vector<SpringDirection> springs(3);
  for (int j = 0; j < 3; ++j) {
    const int node = 11 * j + 2;
    springs[j] = {{3 * node, 3 * node + 1, 3 * node + 2}, Eigen::Vector3d::Random().normalized()};
    changed.block<3, 3>(3 * node, 3 * node) += k[j] * springs[j].v * springs[j].v.transpose();
  }
  update.append({springs.data(), 1}, *solver, Chain::size);  // in two parts
  update.append({springs.data() + 1, 2}, *solver, Chain::size);
  update.change(k);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(Chain::size);
  Eigen::VectorXd x(Chain::size);
  solver->apply({b.data(), Chain::size}, {x.data(), Chain::size});
  EXPECT_GT((changed * x - b).norm(), 1e-3 * b.norm());
  update.correct({x.data(), Chain::size});
  EXPECT_LT((changed * x - b).norm(), 1e-10 * b.norm());
}

}  // namespace
}  // namespace gnomon
