// The solvers of K_uu against dense ones.

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <gnomon/linear/inner_solver.hpp>

#include "linear/low_rank_update.hpp"

namespace gnomon::factor_solver_test {
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
    for (int i = 0; i < size; ++i) {
      layout.group.push_back(i / 3);
      layout.component.push_back(static_cast<char>(i % 3));
    }
    for (int node = 0; node < nodes; ++node)
      layout.position.push_back({1.0 * node, std::cos(node), 0});
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
  const Eigen::MatrixXd B =
      Eigen::MatrixXd::Random(Chain::size, 70);  // more columns than it solves at once
  Eigen::MatrixXd X(B.rows(), B.cols());
  solver->apply({B.data(), static_cast<std::size_t>(B.size())},
                {X.data(), static_cast<std::size_t>(X.size())});
  EXPECT_LT((chain.K * X - B).norm(), 1e-10 * B.norm());
}

using Columns = Eigen::MatrixXd;

Columns solved(InnerSolver& solver, const Columns& B) {
  Columns X(B.rows(), B.cols());
  const auto entries = static_cast<std::size_t>(B.size());
  solver.apply({B.data(), entries}, {X.data(), entries});
  return X;
}

TEST(FactorSolver, DividesColumnsAmongThreads) {
  const Chain chain;
  const int threads = omp_get_max_threads(), levels = omp_get_max_active_levels();
  const auto alone = make_factor_solver(chain.layout);
  const auto together = make_factor_solver(chain.layout, {.threads = 0});
  for (const auto* solver : {&alone, &together}) ASSERT_TRUE((*solver)->set_up(chain.values));
  EXPECT_EQ(omp_get_max_active_levels(), levels);
  const Columns B = Columns::Random(Chain::size, 71);
  const Columns expected = solved(*alone, B);
  omp_set_num_threads(3);
  const Columns X = solved(*together, B), again = solved(*together, B);
  omp_set_num_threads(threads);
  EXPECT_LT((X - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ((X - again).norm(), 0);
}

// With factors in single precision, for all units of stiffness and load.
TEST(FactorSolver, SolvesForOneColumnByRoundedFactors) {
  for (const double unit : {1e-45, 1.0, 1e45}) {
    Chain chain;
    for (double& value : chain.values) value *= unit;
    const auto whole = make_factor_solver(chain.layout);
    const auto rounded = make_factor_solver(chain.layout, {.rounded = 0});
    for (const auto* solver : {&whole, &rounded}) ASSERT_TRUE((*solver)->set_up(chain.values));
    for (const double size : {1e-60, 1.0, 1e60}) {
      const Columns b = size * Columns::Random(Chain::size, 1), x = solved(*whole, b);
      const double error = (solved(*rounded, b) - x).norm() / x.norm();
      EXPECT_LT(error, 1e-4);
      EXPECT_GT(error, 1e-12);  // they are rounded
    }
    EXPECT_EQ(solved(*rounded, Columns::Zero(Chain::size, 1)).norm(), 0);
  }
}

TEST(Multigrid, TakesManyColumnsAsOneAfterTheOther) {
  if (!has_multigrid()) GTEST_SKIP() << "built without PETSc";
  const Chain chain;
  const auto solver = make_multigrid_solver(chain.layout);
  ASSERT_TRUE(solver->set_up(chain.values));
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(Chain::size, 5);
  Eigen::MatrixXd together(B.rows(), B.cols());
  solver->apply({B.data(), static_cast<std::size_t>(B.size())},
                {together.data(), static_cast<std::size_t>(together.size())});
  for (long j = 0; j < B.cols(); ++j) {
    Eigen::VectorXd alone(B.rows());
    solver->apply({B.col(j).data(), Chain::size}, {alone.data(), Chain::size});
    EXPECT_GT(alone.norm(), 0);
    EXPECT_EQ(together.col(j), alone) << j;
  }
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

/// A few entries from `first` on.
SparseVector somewhere(int first) {
  SparseVector result;
  for (int k = 0; k < 5; ++k) {
    result.index.push_back(first + 2 * k);
    result.value.push_back(Eigen::internal::random(-1.0, 1.0));
  }
  return result;
}

Eigen::VectorXd dense(const SparseVector& vector) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Chain::size);
  for (std::size_t k = 0; k < vector.index.size(); ++k) result[vector.index[k]] = vector.value[k];
  return result;
}

TEST(LowRankUpdate, IsTheInverseOfTheChangedMatrix) {
  const Chain chain;
  const auto solver = make_factor_solver(chain.layout);
  ASSERT_TRUE(solver->set_up(chain.values));
  LowRankUpdate update;
  std::vector<RankOneTerm> terms = {{7, 50, somewhere(3), somewhere(4)},
                                    {2, 0, somewhere(20), somewhere(30)},
                                    {9, -0.03, somewhere(60), somewhere(60)}};
  EXPECT_EQ(update.columns_to_solve(terms), 3);
  update.set(terms, *solver, Chain::size);
  terms.erase(terms.begin() +
              1);  // one term goes, one changes direction, one is new, one changes in k and v
  terms[0].u = somewhere(50);
  terms[1].k = 2;
  terms[1].v = somewhere(70);
  terms.push_back({1, 4, somewhere(90), somewhere(80)});
  EXPECT_EQ(update.columns_to_solve(terms), 2);
  update.set(terms, *solver, Chain::size);
  Eigen::MatrixXd changed = chain.K;
  for (const RankOneTerm& term : terms)
    changed += term.k * dense(term.u) * dense(term.v).transpose();
  const Eigen::VectorXd b = Eigen::VectorXd::Random(Chain::size);
  Eigen::VectorXd x(Chain::size);
  solver->apply({b.data(), Chain::size}, {x.data(), Chain::size});
  EXPECT_GT((changed * x - b).norm(), 1e-3 * b.norm());
  update.correct({x.data(), Chain::size});
  EXPECT_LT((changed * x - b).norm(), 1e-9 * b.norm());
}

}  // namespace
}  // namespace gnomon::factor_solver_test
