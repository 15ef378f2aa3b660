// Flexible GMRES (SPFGMR) on the exact Jacobian, preconditioned by its blocks.
#pragma once

#include <sunlinsol/sunlinsol_spfgmr.h>

#include <gnomon/base/counters.hpp>
#include <gnomon/linear/block_preconditioner.hpp>

#include "newton/setup_policy.hpp"
#include "newton/sun_linear_solver.hpp"

namespace gnomon::sundials {

/// Keeps its preconditioner while this costs less than a new one (SetupPolicy).
class BlockSolver : public LinearSolver {
public:
  /// References must outlive the solver. Errors as BlockPreconditioner.
  BlockSolver(const Structure& structure, Counters& counters, const InnerSolverMaker& inner);

  void set_up(std::span<const double> J) override { set_up(J, false); }
  /// `anew`: with a new preconditioner even if the old one is good enough.
  void set_up(std::span<const double> J, bool anew);
  void solve(std::span<const double> b, std::span<double> x, double reduction) override {
    constexpr double useful = 0.3;  // to Newton's method
    solve(b, x, reduction, useful);
  }
  /// Throws RecoverableError, with b as it was, when even a fresh preconditioner brings the
  /// residual neither to `reduction` nor to `acceptable`.
  void solve(std::span<const double> b, std::span<double> x, double reduction, double acceptable);
  /// Iterations of the last solve, if its preconditioner was fresh; else zero.
  int fresh_iterations() const { return fresh_iterations_; }

private:
  void set_up_preconditioner();
  /// Fills solution_ by right_; returns the reduction reached.
  double iterate(double reduction);

  const Structure& structure_;
  Counters& counters_;
  BlockPreconditioner preconditioner_;
  SetupPolicy policy_;
  std::span<const double> J_;
  Context context_;
  VectorOwner right_, solution_, row_scale_;
  LinearSolverOwner gmres_;
  int fresh_iterations_ = 0;
};

}  // namespace gnomon::sundials
