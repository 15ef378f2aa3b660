#include "newton/newton_policy.hpp"

#include <algorithm>
#include <gnomon/base/processes.hpp>

namespace gnomon {

void NewtonPolicy::begin(double rate_weight) {
  rate_weight_ = rate_weight;
  current_ = previous_ = 0;
  iterations_ = 0;
  fresh_ = false;
  began_with_kept_factors_ = options_.keep_factors && has_factors_;
}

/// The residual that ends every iteration.
double NewtonPolicy::target() const {
  return iterations_ == 0 ? options_.guess * options_.tolerance : options_.tolerance;
}

/// Steps that shrink by `rate` add up to rate / (1 - rate) times the last one: the estimated
/// distance from the solution, so that the last iterate is not solved again to prove itself. The
/// rate is that of the residuals, which is known after the first step, whatever the factors.
/// An iterate on another branch than the last one has left the equations whose rate is known.
bool NewtonPolicy::near_enough(const Iterate& iterate) const {
  if (options_.fraction == 0 || iterations_ == 0 || switched_) return false;
  if (current_ > iterate.level * options_.balance || current_ >= previous_) return false;
  const double rate = current_ / previous_;
  return rate / (1 - rate) * iterate.change <= options_.fraction;
}

NewtonPolicy::Verdict NewtonPolicy::judge(const Iterate& iterate) {
  previous_ = current_;
  current_ = iterate.residual;
  switched_ = !on_all_processes(iterate.branch == branch_);
  branch_ = iterate.branch;
  const Verdict verdict = this->verdict(iterate);
  if (verdict == Verdict::done || verdict == Verdict::rounding) careful_ = false;
  return verdict;
}

NewtonPolicy::Verdict NewtonPolicy::verdict(const Iterate& iterate) const {
  if (current_ <= target() || near_enough(iterate)) return Verdict::done;
  if (at_rounding()) return Verdict::rounding;
  if (iterations_ < options_.max_iterations) return Verdict::go_on;
  return options_.acceptable_at_the_end && acceptable() ? Verdict::rounding : Verdict::failed;
}

bool NewtonPolicy::at_rounding() const {
  return iterations_ >= options_.rounding_after && acceptable() &&
         (fresh_ || !options_.rounding_needs_fresh) &&
         current_ > options_.rounding_contraction * previous_;
}

bool NewtonPolicy::contracts_slowly() const {
  return iterations_ > 0 && current_ > options_.slow * previous_;
}

bool NewtonPolicy::factors_serve() const {
  if (!options_.keep_factors || !has_factors_ || !on_all_processes(branch_ == factored_branch_))
    return false;
  const double range = options_.rate_weight_range;
  if (range > 0 && (rate_weight_ > range * factored_rate_weight_ ||
                    factored_rate_weight_ > range * rate_weight_))
    return false;
  return !contracts_slowly();
}

/// Most set-ups follow a change of the branch or of the weight of the rates, of which the slow part
/// knows nothing. It is the suspect when an iteration on one branch contracts slowly, or when there
/// are many of them.
bool NewtonPolicy::old_part_hinders() const {
  constexpr int many = 8;
  return !options_.keep_factors || careful_ || iterations_ >= many ||
         (contracts_slowly() && !switched_);
}

NewtonPolicy::Plan NewtonPolicy::plan(bool demanded) {
  fresh_ = demanded || !factors_serve();
  if (fresh_) has_factors_ = false;
  const Plan plan{
      .set_up = fresh_, .whole = fresh_ && old_part_hinders(), .reduction = reduction()};
  ++iterations_;
  return plan;
}

void NewtonPolicy::factors_made() {
  has_factors_ = true;
  factored_rate_weight_ = rate_weight_;
  factored_branch_ = branch_;
}

/// Forcing term. With a fresh Jacobian the second choice of Eisenstat and Walker (SIAM J. Sci.
/// Comput. 17 (1996) 16), 0.9 (current / previous)^2: so that the solve is as accurate as the
/// expected contraction. A kept Jacobian contracts by the same factor again, and a tenth of that
/// factor is enough.
double NewtonPolicy::reduction() const {
  // A step that does not resolve the sign of a contact node switches it at random. The start of the
  // groove (20x41x10 elements) takes 5 iterations with 1e-4, and with 0.05 fails after 15; an inner
  // iteration costs a hundredth of a factorization.
  constexpr double loosest = 1e-4;
  // GMRES on scaled rows does not reach smaller values; and less than a fifth of the residual that
  // ends the iteration is useless.
  constexpr double tightest = 1e-10, margin = 0.2;
  if (previous_ <= 0) return loosest;
  const double contraction = current_ / previous_;
  const double reduction = fresh_ ? 0.9 * contraction * contraction : 0.1 * contraction;
  const double least = std::max(tightest, margin * options_.tolerance / current_);
  return std::clamp(reduction, std::min(least, loosest), loosest);
}

}  // namespace gnomon
