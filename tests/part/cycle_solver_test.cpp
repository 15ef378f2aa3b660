// The block solver on the Jacobians of several phases, against the properties that follow from its
// derivation.

#include <cmath>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/model/problem.hpp>

#include "linear/block_preconditioner.hpp"
#include "part/cyclic_flat.hpp"

namespace gnomon::cycle_solver_test {
namespace {

using namespace testing;

class CycleSolver : public Cycles {
protected:
  /// A coarse flat, in friction under a force, that has worn for a while.
  ModelRun worn(int phases, const Overrides& more = {}) {
    Overrides overrides = {"mesh.factor=2", "friction.coefficient=0.3",
                           fmt::format("cycle.phases={}", phases)};
    overrides.insert(overrides.end(), more.begin(), more.end());
    flat_ = model(text(reciprocating), overrides);
    return run_model(*flat_, "backward-euler", 10, 1e-4, 40);
  }
  /// Of a step of this size.
  std::vector<double> jacobian(const std::vector<double>& y, double step) const {
    const Structure& structure = flat_->system().structure();
    std::vector<double> J(structure.pattern.nonzeros());
    const std::vector<double> rest(structure.size, 0.0);
    flat_->system().jacobian({0, y, rest}, 1 / step, J);
    return J;
  }
  std::unique_ptr<Model> flat_;
};

/// Drops the derivatives that the preconditioner drops: those of equilibrium by the shape, and of
/// wear by the shape of neighbouring nodes.
void decouple(const Structure& s, std::vector<double>& J) {
  for (int j = 0; j < s.pattern.size(); ++j)
    for (int k = s.pattern.column_start[j]; k < s.pattern.column_start[j + 1]; ++k) {
      const int i = s.pattern.row_index[k];
      const bool surface = s.block_of(j).role == Role::evolution;
      const bool shape = surface || s.block_of(j).role == Role::extension;
      if ((s.block_of(i).role == Role::stiffness || s.block_of(i).role == Role::rigid) && shape)
        J[k] = 0;
      if (s.block_of(i).role == Role::evolution && surface && s.group[i] != s.group[j]) J[k] = 0;
    }
}

/// Gives all phases the stiffness of the first, symmetric. Theirs differ by the change of the
/// normals with the displacement, and that of friction.
void share_stiffness(const Structure& s, std::vector<double>& J) {
  std::vector<std::vector<int>> unknowns;  // by phase
  for (int i : unknowns_of(s, {Role::stiffness})) {
    const auto owner = static_cast<std::size_t>(s.block_of(i).owner);
    if (unknowns.size() <= owner) unknowns.resize(owner + 1);
    unknowns[owner].push_back(i);
  }
  const std::vector<int>& first = unknowns.front();
  for (std::size_t a = 0; a < first.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const int here = s.pattern.find(first[a], first[b]),
                there = s.pattern.find(first[b], first[a]);
      if (here < 0 || there < 0) continue;
      const double mean = (J[here] + J[there]) / 2;
      for (const std::vector<int>& own : unknowns)
        J[s.pattern.find(own[a], own[b])] = J[s.pattern.find(own[b], own[a])] = mean;
    }
}

TEST_F(CycleSolver, IsTheInverseOfWhatItKeeps) {
  for (const char* form : {"eliminated", "multiplier"}) {
    const State state = worn(3, {std::string("shape.constraint=") + form}).last();
    const Structure& structure = flat_->system().structure();
    std::vector<double> J = jacobian(state.y, 10);
    decouple(structure, J);
    share_stiffness(structure, J);
    BlockPreconditioner preconditioner(structure, factor_solvers());
    preconditioner.refresh(J);
    EXPECT_EQ(preconditioner.set_up(true), 2);  // of the body, whatever phases; of the mesh motion
    const long n = structure.size;
    std::vector<double> r(n), z(n);
    for (long j = 0; j < n; ++j) {
      std::vector<double> unit(n, 0.0);
      unit[j] = structure.unknown_scale[j];
      multiply(structure.pattern, J, unit, r);
      preconditioner.apply(r, z);
      for (long i = 0; i < n; ++i)
        ASSERT_NEAR(z[i], unit[i], 1e-8 * structure.unknown_scale[i]) << i << " " << j;
    }
  }
}

/// A phase more is one more in the same solves, not more of them.
TEST_F(CycleSolver, IterationsHardlyGrowWithThePhases) {
  const auto iterations_per_solve = [&](int phases) {
    const Counters counters = worn(phases, {"solver.method=block"}).counters;
    return double(counters.krylov_iterations) / double(counters.linear_solves);
  };
  const double few = iterations_per_solve(2);
  EXPECT_GT(few, 1);
  EXPECT_LT(iterations_per_solve(12), 1.5 * few);
}

}  // namespace
}  // namespace gnomon::cycle_solver_test
