// The constants of the Newton policy (src/newton/newton_policy.hpp), in one place.
#pragma once

namespace gnomon {

/// When a Newton iteration is done, when it has failed, and how long its factors are kept.
/// "Residual" means the largest one, each row divided by its Structure::row_scale; for rows with
/// rates the scale is larger if rounding of y requires it (ResidualNorm).
struct NewtonOptions {
  /// The iteration is done below this residual: sums of it over the surface, such as the load that
  /// contact carries, then hold to ten digits. It is used only in NewtonPolicy::target().
  double tolerance = 1e-11;
  /// In a step of known error it is also done when the estimated distance from the solution is
  /// below this part of the tolerated error of the step (kappa of Hairer and Wanner II, IV.8; only
  /// where NonlinearFunction::distance is given) ...
  double fraction = 0;
  /// ... and the residual is below this value (times the part of the typical pressures that act):
  /// forces are in balance, and the rates that the next stage starts with are as accurate. A full
  /// step leaves no residual in linear rows, so that mostly those of the forces are far smaller. On
  /// the pin (40x40, esdirk-3, rtol 1e-3) 1e-3 and
  /// 1e-2 save 15 and 24 of 136 iterations and raise the error from 8.2e-4 to 9.4e-4 and 1.4e-3.
  double balance = 1e-3;
  /// A residual that no longer decreases is accepted below this value: rounding stops the iteration
  /// of a stiff body or a fine mesh before `tolerance` is reached.
  double acceptable = 1e-9;
  /// A guess is accepted without an iteration below this part of `tolerance`. The value is KINSOL's
  /// own.
  double guess = 0.01;
  int max_iterations = 30;
  /// Whether a residual below `acceptable` is good enough after max_iterations.
  bool acceptable_at_the_end = true;

  /// Modified Newton: factors are kept while the conditions below hold. Otherwise each iteration
  /// makes its own.
  bool keep_factors = false;
  /// Kept factors are given up when an iteration leaves more than this part of the residual. At
  /// 0.2, the way from 1 to 1e-11 takes 16 iterations; with fresh factors it takes about five, each
  /// with a factorization, which costs as much as 3 solves in 2D and up to 60 in 3D.
  double slow = 0.2;
  /// Kept factors are given up when the weight of the rates in J (1 / (h a_ii)) has changed by more
  /// than this factor: beyond it they contract by 0.3 to 0.4 per iteration in modes that the rates
  /// dominate, which is worse than `slow`. 0: the caller decides.
  double rate_weight_range = 1.4;

  /// An iteration is at rounding when its residual is acceptable, has fallen by less than
  /// `rounding_contraction` ...
  double rounding_contraction = 0.5;
  bool rounding_needs_fresh = true;  ///< ... by a step with a fresh Jacobian ...
  int rounding_after = 1;            ///< ... after at least this number of iterations.
};

/// The options of one-step methods. They allow twice the iterations of full Newton, because kept
/// factors contract more slowly.
inline constexpr NewtonOptions modified_newton{.max_iterations = 60, .keep_factors = true};

/// The options with IDA. Each of the differences is needed for IDA's step size control:
/// - IDA's guess is its predictor: its error estimate is the distance from it, so a predictor
///   within the tolerance is accepted;
/// - IDA shortens a step that fails after 30 iterations, so that no residual above the tolerance
///   needs to be accepted then;
/// - IDA monitors the weight of the rates itself and demands the set-ups that its changes require
///   (limits 3/5 and 5/3);
/// - a slow iteration with kept factors is taken to be at rounding from the third iteration on,
///   without a factorization to confirm it.
inline constexpr NewtonOptions newton_in_ida{.guess = 1,
                                             .max_iterations = 30,
                                             .acceptable_at_the_end = false,
                                             .keep_factors = true,
                                             .rate_weight_range = 0,
                                             .rounding_contraction = 0.2,
                                             .rounding_needs_fresh = false,
                                             .rounding_after = 3};

/// The options in steps of known error.
constexpr NewtonOptions within_time_error(NewtonOptions options, double fraction) {
  options.fraction = fraction;
  return options;
}

}  // namespace gnomon
