// The decisions of a semismooth Newton iteration, without the iteration: from values to decisions.
// KINSOL (newton.cpp) and IDA (semismooth_newton.cpp) both use it.
#pragma once

#include <gnomon/newton/newton_options.hpp>
#include <gnomon/system/system.hpp>

namespace gnomon {

/// One object per Jacobian: it remembers for which branch and weight the factors were made. A solve
/// does
///
///   begin(); at each iterate: judge(norm), and if it says go_on: plan(branch), a set-up if the
///   plan has one, then factors_made(branch), and a Newton step.
class NewtonPolicy {
public:
  explicit NewtonPolicy(const NewtonOptions& options) : options_(options) {}

  /// Called when a solve begins, at its guess. `rate_weight`: weight of the rates in its Jacobian.
  void begin(double rate_weight = 0);

  enum class Verdict {
    go_on,
    done,      ///< below the target
    rounding,  ///< not below the target, but small and no longer decreasing: accepted
    failed     ///< all allowed iterations were done
  };
  /// Called at each iterate (the guess is the first) with its residual norm.
  Verdict judge(double norm);

  struct Plan {
    bool set_up;       ///< a new Jacobian and its factors must be made at this iterate
    double reduction;  ///< reduction of the linear residual that an iterative solver must reach
  };
  /// The next Newton step, from an iterate on `branch` (empty: the equations are smooth).
  /// `demanded`: the caller needs a set-up for reasons of its own.
  Plan plan(const ActiveSet& branch, bool demanded = false);
  /// The set-up of the last plan has succeeded. Without this call the next plan has one again.
  void factors_made(const ActiveSet& branch);

  /// After a solve that failed: whether kept factors may be the reason, so that it should be
  /// repeated with fresh ones.
  bool began_with_kept_factors() const { return began_with_kept_factors_; }
  /// After this call the next plan has a set-up.
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
  // Data of this solve.
  double rate_weight_ = 0;
  double current_ = 0, previous_ = 0;  // norms of this iterate and the last
  int iterations_ = 0;
  bool fresh_ = false;  // the last or the planned step has a fresh Jacobian
  bool began_with_kept_factors_ = false;
  // Data of the factors.
  bool has_factors_ = false;
  double factored_rate_weight_ = 0;
  ActiveSet factored_branch_;
};

}  // namespace gnomon
