// The decisions of a semismooth Newton iteration, without the iteration: values in, decisions out.
// KINSOL (newton.cpp) and IDA (semismooth_newton.cpp) both ask it.
#pragma once

#include <gnomon/newton/newton_options.hpp>
#include <gnomon/system/system.hpp>

namespace gnomon {

/// One object per Jacobian: it remembers what the factors were made for. A solve goes
///
///   begin(); at each iterate: judge(norm), and if it says go_on: plan(branch), a set-up if the
///   plan has one, then factors_made(branch), and a Newton step.
class NewtonPolicy {
public:
  explicit NewtonPolicy(const NewtonOptions& options) : options_(options) {}

  /// A solve begins, at its guess. `rate_weight`: of the rates in its Jacobian.
  void begin(double rate_weight = 0);

  enum class Verdict {
    go_on,
    done,      ///< below the target
    rounding,  ///< not below the target, but small and no longer falling: accepted
    failed     ///< iterations are used up
  };
  /// At an iterate (the guess first) with this residual norm.
  Verdict judge(double norm);

  struct Plan {
    bool set_up;       ///< a new Jacobian and its factors are to be made at this iterate
    double reduction;  ///< of the linear residual that an iterative linear solver is to reach
  };
  /// The next Newton step, from an iterate on `branch` (empty: the equations are smooth).
  /// `demanded`: the caller needs a set-up for reasons of its own.
  Plan plan(const ActiveSet& branch, bool demanded = false);
  /// The set-up of the last plan has succeeded. Without this call the next plan has one again.
  void factors_made(const ActiveSet& branch);

  /// After a solve that failed: whether kept factors may have led it astray, so that it is worth
  /// repeating with fresh ones.
  bool began_with_kept_factors() const { return began_with_kept_factors_; }
  /// The next plan has a set-up.
  void forget_factors() { has_factors_ = false; }

  /// Newton steps since begin().
  int iterations() const { return iterations_; }

private:
  double target() const;
  bool acceptable() const { return current_ <= options_.acceptable; }
  bool at_rounding() const;
  bool contracts_slowly() const;
  bool factors_serve(const ActiveSet& branch) const;
  double reduction() const;

  NewtonOptions options_;
  // Of this solve.
  double rate_weight_ = 0;
  double current_ = 0, previous_ = 0;  // norms of this iterate and the last
  int iterations_ = 0;
  bool fresh_ = false;  // the last step, or the one planned, has a fresh Jacobian
  bool began_with_kept_factors_ = false;
  // Of the factors.
  bool has_factors_ = false;
  double factored_rate_weight_ = 0;
  ActiveSet factored_branch_;
};

}  // namespace gnomon
