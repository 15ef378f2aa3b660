// The interface of a one-step method to the code that drives it.
#pragma once

#include <gnomon/system/state.hpp>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// Outcome of one attempt at a step.
struct Attempt {
  bool success = false;
  double shorter = 0;    ///< of a step that a jump makes too long: the size to try next [time]
  double error = 0;      ///< estimated error of the step, 1 being the tolerance (ErrorNorm)
  double integral = 0;   ///< integral of IntegratorSettings::integrand over the step, by the method
  std::string reason{};  ///< why it failed
};

/// How an attempt is made.
struct AttemptOptions {
  const ActiveSet* branch = nullptr;  ///< smooth branch to stay on (Point::branch); null: that of y
  bool continuation = false;  ///< if Newton's method fails, solve by continuation in the step
  /// Error of the step, 1 being the tolerance, of which Newton's iterations may leave
  /// IntegratorSettings::nonlinear_fraction. 0: not known, they go on to rounding.
  double error = 0;
  /// A short step that settles the algebraic components. Asked only of the methods of integrators
  /// that settle (Integrator::settles).
  bool settles = false;
};

/// A step from a consistent state to a consistent state. Its solution does not depend on earlier
/// steps, so that steps of any size may follow each other.
class OneStepMethod {
public:
  virtual ~OneStepMethod() = default;
  /// Tries a step of size h; fills `to` (whole) on success.
  virtual Attempt attempt(const State& from, double h, const AttemptOptions& options,
                          State& to) = 0;
  /// `state` has become the start of the next step; values before a kink there cannot be
  /// extrapolated.
  virtual void accept(const State& state, bool kink) = 0;
  /// Dense output of the last attempt: an approximation of y at t [size].
  virtual void interpolate(double t, std::span<double> y) const = 0;

  /// The data of earlier steps that error estimates use; their count is always the same.
  virtual std::vector<double> memory() const { return {}; }
  /// Called after accept() of the state at which memory() gave these numbers.
  virtual void restore(std::span<const double> /*memory*/) {}
};

}  // namespace gnomon
