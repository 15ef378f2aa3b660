// The decisions of a semismooth Newton iteration, without the iteration: from values to decisions.
// KINSOL (newton.cpp) and IDA (semismooth_newton.cpp) both use it.
#pragma once

#include <gnomon/newton/newton_options.hpp>
#include <gnomon/system/system.hpp>
#include <limits>

namespace gnomon {

/// One object per Jacobian: it remembers for which branch and weight the factors were made. A solve
/// does
///
///   begin(); at each iterate: judge(iterate), and if it says go_on: plan(), a set-up if the plan
///   has one, then factors_made(), and a Newton step.
class NewtonPolicy {
public:
  explicit NewtonPolicy(const NewtonOptions& options) : options_(options) {}

  /// Called when a solve begins, at its guess. `rate_weight`: weight of the rates in its Jacobian.
  void begin(double rate_weight = 0);

  /// What is known of an iterate.
  struct Iterate {
    double residual;        ///< its norm
    ActiveSet branch = {};  ///< on which it lies (empty: the equations are smooth)
    /// Size of the step that led to it, in units of the tolerated error; infinite: not measured.
    double change = std::numeric_limits<double>::infinity();
    double level = 1;  ///< part of the typical forces that act (PressureLevel)
  };
  enum class Verdict {
    go_on,
    done,      ///< below the target, or near enough to the solution for the time error
    rounding,  ///< not below the target, but small and no longer decreasing: accepted
    failed     ///< all allowed iterations were done
  };
  /// Called at each iterate, the guess first.
  Verdict judge(const Iterate& iterate);

  struct Plan {
    bool set_up;       ///< a new Jacobian and its factors must be made at this iterate
    bool whole;        ///< ... with its slow part, even where an older one is at hand (SlowPart)
    double reduction;  ///< reduction of the linear residual that an iterative solver must reach
  };
  /// The next Newton step, from the iterate judged last. `demanded`: the caller needs a set-up for
  /// reasons of its own.
  Plan plan(bool demanded = false);
  /// The set-up of the last plan has succeeded. Without this call the next plan has one again.
  void factors_made();

  /// After a solve that failed: whether kept factors may be the reason, so that it should be
  /// repeated with fresh ones.
  bool began_with_kept_factors() const { return began_with_kept_factors_; }
  /// After this call the next plan has a set-up, and until a solve succeeds set-ups are whole.
  void forget_factors() {
    has_factors_ = false;
    careful_ = true;
  }

  /// Newton steps since begin().
  int iterations() const { return iterations_; }

private:
  Verdict verdict(const Iterate& iterate) const;
  double target() const;
  bool near_enough(const Iterate& iterate) const;
  bool acceptable() const { return current_ <= options_.acceptable; }
  bool at_rounding() const;
  bool contracts_slowly() const;
  bool factors_serve() const;
  bool old_part_hinders() const;
  double reduction() const;

  NewtonOptions options_;
  // Data of this solve.
  double rate_weight_ = 0;
  double current_ = 0, previous_ = 0;  // residuals of this iterate and the last
  bool switched_ = false;              // they lie on different branches
  ActiveSet branch_;                   // of this iterate
  int iterations_ = 0;
  bool fresh_ = false;  // the last or the planned step has a fresh Jacobian
  bool began_with_kept_factors_ = false;
  // Data of the factors.
  bool has_factors_ = false;
  bool careful_ = false;  // the last solve failed
  double factored_rate_weight_ = 0;
  ActiveSet factored_branch_;
};

}  // namespace gnomon
