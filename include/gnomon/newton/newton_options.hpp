// The constants of the Newton policy (src/newton/newton_policy.hpp), in one place.
#pragma once

namespace gnomon {

/// When a Newton iteration is done, when it has failed, and how long its factors are kept. Every
/// integrator solves its equations to the same tolerance, so that conserved quantities hold
/// whatever the error tolerance of the time integration.
///
/// All residuals are the largest one, each row divided by its Structure::row_scale; rows with rates
/// allow for the rounding of y where that is more (ResidualNorm).
struct NewtonOptions {
  /// The iteration is done below this residual: sums of it over the surface, such as the load that
  /// contact carries, then hold to ten digits. It enters in NewtonPolicy::target() alone.
  double tolerance = 1e-11;
  /// A residual that does not fall any more is accepted below this: rounding stops the iteration of
  /// a stiff body or a fine mesh before `tolerance` is reached.
  double acceptable = 1e-9;
  /// A guess is accepted without an iteration below this part of `tolerance`. The value is KINSOL's
  /// own.
  double guess = 0.01;
  int max_iterations = 30;
  /// Whether a residual below `acceptable` is good enough after max_iterations.
  bool acceptable_at_the_end = true;

  /// Modified Newton: factors are kept while they serve (below). Otherwise each iteration makes
  /// its own.
  bool keep_factors = false;
  /// Kept factors no longer serve when an iteration reduces the residual by less than this factor.
  /// From 1 to 1e-11 takes 16 iterations at 0.2; fresh ones about five, at a
  /// factorization each, which costs 3 solves in 2D and up to 60 in 3D.
  double slow = 0.2;
  /// Kept factors no longer serve when the weight of the rates in J (1 / (h a_ii)) has changed by
  /// more than this factor: then they contract by 0.3 to 0.4 per iteration in modes that the rates
  /// dominate, worse than `slow`. 0: the caller decides about this.
  double rate_weight_range = 1.4;

  /// An iteration is at rounding when its residual is acceptable, has fallen by less than
  /// `rounding_contraction` ...
  double rounding_contraction = 0.5;
  bool rounding_needs_fresh = true;  ///< ... by a step with a fresh Jacobian ...
  int rounding_after = 1;            ///< ... after this number of iterations at least.
};

/// What one-step methods solve their equations with. Twice the iterations of full Newton, since
/// kept factors contract more slowly.
inline constexpr NewtonOptions modified_newton{.max_iterations = 60, .keep_factors = true};

/// What IDA solves its equations with. The differences, each of which keeps IDA's steps what they
/// are:
/// - IDA's guess is its predictor: its error estimate is the distance to it, so a predictor within
///   the tolerance may stay;
/// - IDA cuts a step that fails, after 30 iterations, and nothing above the tolerance need be
///   accepted at their end;
/// - IDA watches the weight of the rates itself and demands the set-ups that it causes (limits 3/5
///   and 5/3 on its change);
/// - a slow iteration with kept factors is taken to be at rounding from the third iteration on,
///   without a factorization to prove it.
inline constexpr NewtonOptions newton_in_ida{.guess = 1,
                                             .max_iterations = 30,
                                             .acceptable_at_the_end = false,
                                             .keep_factors = true,
                                             .rate_weight_range = 0,
                                             .rounding_contraction = 0.2,
                                             .rounding_needs_fresh = false,
                                             .rounding_after = 3};

}  // namespace gnomon
