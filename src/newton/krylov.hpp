// Flexible GMRES (SPFGMR) on the exact Jacobian, preconditioned by its blocks.
#pragma once

#include <sunlinsol/sunlinsol_spfgmr.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/counters.hpp>

#include "linear/block_preconditioner.hpp"
#include "newton/sundials_solvers.hpp"

namespace gnomon::sundials {

/// A set-up is due when the additional cost of the old preconditioner (Krylov iterations beyond
/// those of a fresh one, and updates) has reached the cost of a set-up. Counts decide, not measured
/// times, so that runs are reproducible.
class SetupPolicy {
public:
  bool due() const { return failed_ || spent_ >= cost_; }
  /// Whether the mesh motion must be set up too, because a fresh stiffness alone no longer reduces
  /// the iterations.
  bool whole() const { return failed_ || fresh_rate_ > 1.5 * whole_rate_; }

  /// Called after a set-up. `cost`: in applications of the preconditioner.
  void made(bool whole, double cost) {
    cost_ = cost;
    if (whole) whole_rate_ = 0;
    fresh_ = true;
    failed_ = false;
    fresh_rate_ = spent_ = 0;
  }
  /// Called after a solve that reduced the residual by `digits` powers of ten.
  void solved(int iterations, double digits) {
    const double rate = iterations / std::max(digits, 0.1);
    if (fresh_) {
      fresh_rate_ = rate;
      if (whole_rate_ == 0) whole_rate_ = rate;
    }
    spent_ += applications_an_iteration * std::max(0.0, iterations - fresh_rate_ * digits);
    fresh_ = false;
  }
  /// Called before an update that costs that many applications; the update is not made if a set-up
  /// is due then.
  void spent(double applications) { spent_ += applications; }
  /// Called after a solve that did not converge.
  void failed() { failed_ = true; }
  /// Whether there was no solve since the set-up.
  bool fresh() const { return fresh_; }

private:
  static constexpr double applications_an_iteration = 2;  // product with J and orthogonalisation
  double cost_ = 0, whole_rate_ = 0;
  bool fresh_ = false, failed_ = true;
  double fresh_rate_ = 0, spent_ = 0;
};

/// Keeps its preconditioner while this costs less than a new one (SetupPolicy).
class BlockSolver : public LinearSolver {
public:
  /// References must outlive the solver. Errors as BlockPreconditioner.
  BlockSolver(const Structure& structure, Counters& counters, const InnerSolverMaker& inner)
      : structure_(structure),
        counters_(counters),
        preconditioner_(structure, inner),
        right_(make_vector(structure.size, context_)),
        solution_(make_vector(structure.size, context_)),
        row_scale_(make_vector(structure.size, context_)),
        gmres_(SUNLinSol_SPFGMR(solution_.get(), SUN_PREC_RIGHT, most_iterations, context_)) {
    check(gmres_.get(), "SUNLinSol_SPFGMR");
    for (long i = 0; i < structure.size; ++i)
      view(row_scale_.get())[i] = 1 / structure.row_scale[i];
    const auto product = [](void* self, N_Vector v, N_Vector Jv) {
      const BlockSolver& s = *static_cast<BlockSolver*>(self);
      multiply(s.structure_.pattern, s.J_, view(v), view(Jv));
      return 0;
    };
    const auto precondition = [](void* self, N_Vector r, N_Vector z, sunrealtype, int) {
      static_cast<BlockSolver*>(self)->preconditioner_.apply(view(r), view(z));
      return 0;
    };
    check(SUNLinSolSetATimes(gmres_.get(), this, product), "SUNLinSolSetATimes");
    check(SUNLinSolSetPreconditioner(gmres_.get(), this, nullptr, precondition),
          "SUNLinSolSetPreconditioner");
    // Krylov vectors have scaled rows; the input of the preconditioner is scaled back.
    check(SUNLinSolSetScalingVectors(gmres_.get(), row_scale_.get(), row_scale_.get()),
          "SUNLinSolSetScalingVectors");
    check(SUNLinSolInitialize(gmres_.get()), "SUNLinSolInitialize");
  }

  void set_up(std::span<const double> J) override { set_up(J, false); }
  /// `anew`: with a new preconditioner even if the old one is good enough.
  void set_up(std::span<const double> J, bool anew) {
    require_finite(J, "the Jacobian");
    J_ = J;
    preconditioner_.refresh(J);
    policy_.spent(preconditioner_.update_cost());
    if (anew || policy_.due())
      set_up_preconditioner();
    else
      preconditioner_.update();
  }
  void solve(std::span<const double> b, std::span<double> x, double reduction) override {
    constexpr double useful = 0.3;  // to Newton's method
    solve(b, x, reduction, useful);
  }

  /// Throws RecoverableError, with b as it was, when even a fresh preconditioner brings the
  /// residual neither to `reduction` nor to `acceptable`.
  void solve(std::span<const double> b, std::span<double> x, double reduction, double acceptable) {
    std::ranges::copy(b, view(right_.get()).begin());
    bool fresh = policy_.fresh();
    double reached = iterate(reduction);
    if (reached > reduction && !fresh) {
      set_up_preconditioner();
      reached = iterate(reduction);
      fresh = true;
    }
    fresh_iterations_ = fresh ? SUNLinSolNumIters(gmres_.get()) : 0;
    if (reached > std::max(reduction, acceptable))
      throw RecoverableError("the block solver did not converge");
    std::ranges::copy(view(solution_.get()), x.begin());
  }

  /// Iterations of the last solve, if its preconditioner was fresh; else zero.
  int fresh_iterations() const { return fresh_iterations_; }

private:
  static constexpr int most_iterations = 80;

  void set_up_preconditioner() {
    const bool whole = policy_.whole();
    policy_.failed();  // valid until the set-up has succeeded
    ++counters_.preconditioner_setups;
    counters_.factorizations += preconditioner_.set_up(whole);
    policy_.made(whole, preconditioner_.set_up_cost());
  }

  /// Fills solution_ by right_; returns the reduction reached.
  double iterate(double reduction) {
    SUNLinearSolver gmres = gmres_.get();
    const double size = N_VWL2Norm(right_.get(), row_scale_.get());
    N_VConst(0, solution_.get());
    if (size == 0) return 0;
    check(SUNLinSolSetZeroGuess(gmres, SUNTRUE), "SUNLinSolSetZeroGuess");
    check(SUNLinSolSolve(gmres, nullptr, solution_.get(), right_.get(), reduction * size),
          "SUNLinSolSolve");
    const int iterations = SUNLinSolNumIters(gmres);
    counters_.krylov_iterations += iterations;
    const double reached = SUNLinSolResNorm(gmres) / size;
    if (!(reached < 1)) {
      policy_.failed();
      return 1;
    }
    policy_.solved(iterations, -std::log10(std::max(reached, 1e-16)));
    if (reached > reduction) policy_.failed();
    return reached;
  }

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
