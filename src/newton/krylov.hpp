// Flexible GMRES (SPFGMR) on the exact Jacobian, preconditioned by its blocks.
#pragma once

#include <sunlinsol/sunlinsol_spfgmr.h>

#include <gnomon/base/counters.hpp>
#include <gnomon/linear/block_preconditioner.hpp>

#include "newton/linear_solver.hpp"
#include "newton/setup_policy.hpp"

namespace gnomon::sundials {

/// Solves J x = b for a sequence of Jacobians on one pattern, and keeps its preconditioner while
/// this costs less than a new one (SetupPolicy).
class BlockSolver {
public:
  /// References must outlive the solver. Errors as BlockPreconditioner.
  BlockSolver(const Structure& structure, Counters& counters, SUNContext context);

  /// Takes a new Jacobian, which must outlive the solves with it. `anew`: with a new preconditioner
  /// even if the old one is good enough.
  void set_up(std::span<const double> J, bool anew = false);
  /// Solves until the residual, rows divided by their scales, has fallen to `reduction` of the
  /// right side's in the Euclidean norm. b may be x. Throws RecoverableError, with b as it was,
  /// when even a fresh preconditioner brings the residual neither so far down nor to `acceptable`.
  void solve(N_Vector b, N_Vector x, double reduction, double acceptable);
  /// Iterations of the last solve, if its preconditioner was fresh; else zero.
  int fresh_iterations() const { return fresh_iterations_; }

private:
  void set_up_preconditioner();
  /// Fills solution_; returns the reduction reached.
  double iterate(N_Vector b, double reduction);

  const Structure& structure_;
  Counters& counters_;
  BlockPreconditioner preconditioner_;
  SetupPolicy policy_;
  std::span<const double> J_;
  VectorOwner solution_, row_scale_;
  LinearSolverOwner gmres_;
  int fresh_iterations_ = 0;
};

}  // namespace gnomon::sundials
