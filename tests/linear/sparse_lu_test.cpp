#include <gtest/gtest.h>
#include <pthread.h>

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <gnomon/linear/sparse_lu.hpp>
#include <random>
#include <thread>

namespace gnomon::sparse_lu_test {
namespace {

/// A chain of groups of `members` unknowns, neighbours coupled, random values, zero diagonal in the
/// last member of each group (as an active contact multiplier has).
struct Chain {
  SparsePattern pattern;
  std::vector<int> group;
  std::vector<double> values;
  Eigen::MatrixXd dense;

  Chain(int groups, int members) {
    const int n = groups * members;
    PatternBuilder builder(n);
    for (int g = 0; g < groups; ++g) {
      std::vector<int> mine, near;
      for (int m = 0; m < members; ++m) mine.push_back(g * members + m), group.push_back(g);
      near = mine;
      if (g + 1 < groups)
        for (int m = 0; m < members; ++m) near.push_back((g + 1) * members + m);
      builder.add(near, mine);
      builder.add(mine, near);
    }
    pattern = builder.build();
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    dense = Eigen::MatrixXd::Zero(n, n);
    for (int j = 0; j < n; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const int i = pattern.row_index[k];
        values.push_back(uniform(generator) + (i == j ? 4 : 0));
        if (i == j && i % members == members - 1) values.back() = 0;
        dense(i, j) = values.back();
      }
  }
};

TEST(SparseLu, SolvesWhatADenseFactorizationSolves) {
  const Chain chain(30, 4);
  SparseLu lu(chain.pattern, chain.group);
  ASSERT_TRUE(lu.factorize(chain.values));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1, 2);
  Eigen::VectorXd x(120);
  lu.solve({b.data(), 120}, {x.data(), 120});
  EXPECT_LT((x - chain.dense.fullPivLu().solve(b)).norm(), 1e-11 * x.norm());
}

TEST(SparseLu, FactorizesNewValuesOnTheSamePattern) {
  Chain chain(10, 3);
  SparseLu lu(chain.pattern, chain.group);
  ASSERT_TRUE(lu.factorize(chain.values));
  for (double& value : chain.values) value *= 2;
  ASSERT_TRUE(lu.factorize(chain.values));
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(30);
  Eigen::VectorXd x(30);
  lu.solve({b.data(), 30}, {x.data(), 30});
  EXPECT_LT((2 * chain.dense * x - b).norm(), 1e-12);
}

TEST(SparseLu, ReportsASingularMatrix) {
  Chain chain(10, 3);
  SparseLu lu(chain.pattern, chain.group);
  std::fill(chain.values.begin(), chain.values.end(), 0.0);
  EXPECT_FALSE(lu.factorize(chain.values));
}

TEST(NestedDissection, IsAPermutationThatKeepsGroupsTogether) {
  const Chain chain(50, 3);
  const std::vector<int> order = nested_dissection(chain.pattern, chain.group);
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 150; ++i) ASSERT_EQ(sorted[i], i);
  for (int k = 0; k < 150; k += 3) {
    EXPECT_EQ(chain.group[order[k]], chain.group[order[k + 2]]);
    EXPECT_LT(order[k], order[k + 1]);  // the multiplier after its node's displacements
  }
}

volatile std::sig_atomic_t terminations = 0;
extern "C" void count_termination(int) {
  terminations = terminations + 1;
}

// Whoever ends a run expects its checkpoint, not an error of METIS, whose METIS_NodeND has a
// handler of its own.
TEST(NestedDissection, LeavesSignalsToTheProgram) {
  const Chain chain(1000, 1);
  const auto before = std::signal(SIGTERM, count_termination);
  terminations = 0;
  std::atomic<bool> done = false;
  std::thread sender([&done, target = pthread_self()] {
    while (!done) {
      pthread_kill(target, SIGTERM);
      std::raise(SIGTERM);  // in this thread, where a jump into METIS would be fatal
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  });
  for (int k = 0; k < 100; ++k) EXPECT_NO_THROW(nested_dissection(chain.pattern, chain.group)) << k;
  done = true;
  sender.join();
  std::signal(SIGTERM, before);
  EXPECT_GT(terminations, 0);
}

}  // namespace
}  // namespace gnomon::sparse_lu_test
