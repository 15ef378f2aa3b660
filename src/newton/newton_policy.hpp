// The decisions of a semismooth Newton iteration, without the iteration: what is measured of an
// iterate, and from these values to decisions.
// KINSOL (newton.cpp) and IDA (sundials_solvers.cpp) both use it.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/fields/block.hpp>
#include <gnomon/newton/newton_options.hpp>
#include <gnomon/system/system.hpp>
#include <limits>
#include <span>
#include <vector>

namespace gnomon {

/// Largest |F_i| / scale_i, where scale_i is Structure::row_scale unless allow_for_rounding() has
/// raised it.
class ResidualNorm {
public:
  explicit ResidualNorm(const Structure& structure)
      : structure_(structure), scale_(structure.row_scale) {}

  double operator()(std::span<const double> F) const {
    double largest = 0;
    for (std::size_t i = 0; i < F.size(); ++i)
      largest = std::max(largest, std::abs(F[i]) / scale_[i]);
    return largest_over_processes(largest);
  }

  const std::vector<double>& scale() const { return scale_; }

  /// Where rates are rate_weight (y - base), in short steps rounding of y may change them by more
  /// than `acceptable` times their scale, so that those rows cannot be solved to this accuracy.
  /// Their scale is raised to the effect of ten rounding errors of y, divided by `acceptable`, if
  /// that is larger.
  void allow_for_rounding(double rate_weight, std::span<const double> y, double acceptable) {
    constexpr double roundings = 10 * std::numeric_limits<double>::epsilon();
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!structure_.differential[i]) continue;
      const double rounding = roundings * rate_weight * std::abs(y[i]);
      scale_[i] = std::max(structure_.row_scale[i], rounding / acceptable);
    }
  }

private:
  const Structure& structure_;
  std::vector<double> scale_;
};

/// The largest contact multiplier in units of its typical value, at least `least` and at most 1.
/// Under a thousandth of the load forces have to balance to a thousandth of what is enough
/// otherwise. 1 for systems without contact.
class PressureLevel {
public:
  explicit PressureLevel(const Structure& structure) : scale_(structure.unknown_scale) {
    for (std::size_t i = 0; i < structure.block.size(); ++i)
      if (structure.block_of(i).role == Role::multiplier)
        multipliers_.push_back(static_cast<int>(i));
  }

  double operator()(std::span<const double> y) const {
    constexpr double least = 1e-6;
    double level = multipliers_.empty() ? 1 : least;
    for (int i : multipliers_) level = std::max(level, std::abs(y[i]) / scale_[i]);
    return std::min(1.0, largest_over_processes(level));
  }

private:
  std::vector<int> multipliers_;
  const std::vector<double>& scale_;
};

/// One object per Jacobian: it remembers for which branch and weight the factors were made. A solve
/// does
///
///   begin(); at each iterate: judge(iterate), and if it says go_on: plan(), a set-up if the plan
///   has one, then factors_made(), and a Newton step.
class NewtonPolicy {
public:
  explicit NewtonPolicy(const NewtonOptions& options) : options_(options) {}

  /// Called when a solve begins, at its guess. `rate_weight`: weight of the rates in its Jacobian.
  void begin(double rate_weight = 0) {
    rate_weight_ = rate_weight;
    current_ = previous_ = 0;
    iterations_ = 0;
    fresh_ = false;
    began_with_kept_factors_ = options_.keep_factors && has_factors_;
  }

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
  Verdict judge(const Iterate& iterate) {
    previous_ = current_;
    current_ = iterate.residual;
    switched_ = !on_all_processes(iterate.branch == branch_);
    branch_ = iterate.branch;
    const Verdict verdict = this->verdict(iterate);
    if (verdict == Verdict::done || verdict == Verdict::rounding) careful_ = false;
    return verdict;
  }

  struct Plan {
    bool set_up;       ///< a new Jacobian and its factors must be made at this iterate
    bool whole;        ///< ... with its slow part, even where an older one is at hand (SlowPart)
    double reduction;  ///< reduction of the linear residual that an iterative solver must reach
  };
  /// The next Newton step, from the iterate judged last. `demanded`: the caller needs a set-up for
  /// reasons of its own.
  Plan plan(bool demanded = false) {
    fresh_ = demanded || !factors_serve();
    if (fresh_) has_factors_ = false;
    const Plan plan{
        .set_up = fresh_, .whole = fresh_ && old_part_hinders(), .reduction = reduction()};
    ++iterations_;
    return plan;
  }
  /// The set-up of the last plan has succeeded. Without this call the next plan has one again.
  void factors_made() {
    has_factors_ = true;
    factored_rate_weight_ = rate_weight_;
    factored_branch_ = branch_;
  }

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
  Verdict verdict(const Iterate& iterate) const {
    if (current_ <= target() || near_enough(iterate)) return Verdict::done;
    if (at_rounding()) return Verdict::rounding;
    if (iterations_ < options_.max_iterations) return Verdict::go_on;
    return options_.acceptable_at_the_end && acceptable() ? Verdict::rounding : Verdict::failed;
  }
  /// The residual that ends every iteration.
  double target() const {
    return iterations_ == 0 ? options_.guess * options_.tolerance : options_.tolerance;
  }
  /// Steps that shrink by `rate` add up to rate / (1 - rate) times the last one: the estimated
  /// distance from the solution, so that the last iterate is not solved again to prove itself. The
  /// rate is that of the residuals, which is known after the first step, whatever the factors.
  /// An iterate on another branch than the last one has left the equations whose rate is known.
  bool near_enough(const Iterate& iterate) const {
    if (options_.fraction == 0 || iterations_ == 0 || switched_) return false;
    if (current_ > iterate.level * options_.balance || current_ >= previous_) return false;
    const double rate = current_ / previous_;
    return rate / (1 - rate) * iterate.change <= options_.fraction;
  }
  bool acceptable() const { return current_ <= options_.acceptable; }
  bool at_rounding() const {
    return iterations_ >= options_.rounding_after && acceptable() &&
           (fresh_ || !options_.rounding_needs_fresh) &&
           current_ > options_.rounding_contraction * previous_;
  }
  bool contracts_slowly() const { return iterations_ > 0 && current_ > options_.slow * previous_; }
  bool factors_serve() const {
    if (!options_.keep_factors || !has_factors_ || !on_all_processes(branch_ == factored_branch_))
      return false;
    const double range = options_.rate_weight_range;
    if (range > 0 && (rate_weight_ > range * factored_rate_weight_ ||
                      factored_rate_weight_ > range * rate_weight_))
      return false;
    return !contracts_slowly();
  }
  /// Most set-ups follow a change of the branch or of the weight of the rates, of which the slow
  /// part knows nothing. It is the suspect when an iteration on one branch contracts slowly, or
  /// when there are many of them.
  bool old_part_hinders() const {
    constexpr int many = 8;
    return !options_.keep_factors || careful_ || iterations_ >= many ||
           (contracts_slowly() && !switched_);
  }

  /// Forcing term. With a fresh Jacobian the second choice of Eisenstat and Walker (SIAM J. Sci.
  /// Comput. 17 (1996) 16), 0.9 (current / previous)^2: so that the solve is as accurate as the
  /// expected contraction. A kept Jacobian contracts by the same factor again, and a tenth of that
  /// factor is enough.
  double reduction() const {
    // A step that does not resolve the sign of a contact node switches it at random. The start of
    // the groove (20x41x10 elements) takes 5 iterations with 1e-4, and with 0.05 fails after 15; an
    // inner iteration costs a hundredth of a factorization.
    constexpr double loosest = 1e-4;
    // GMRES on scaled rows does not reach smaller values; and less than a fifth of the residual
    // that ends the iteration is useless.
    constexpr double tightest = 1e-10, margin = 0.2;
    if (previous_ <= 0) return loosest;
    const double contraction = current_ / previous_;
    const double reduction = fresh_ ? 0.9 * contraction * contraction : 0.1 * contraction;
    const double least = std::max(tightest, margin * options_.tolerance / current_);
    return std::clamp(reduction, std::min(least, loosest), loosest);
  }

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
