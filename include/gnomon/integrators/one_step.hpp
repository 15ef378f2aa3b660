// What a one-step method is to the code that drives it.
#pragma once

#include <gnomon/system/state.hpp>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// Outcome of one attempt at a step.
struct Attempt {
  bool success = false;
  double error = 0;      ///< estimated error of the step, 1 being the tolerance (ErrorNorm)
  double integral = 0;   ///< of IntegratorSettings::integrand over the step, by the method
  std::string reason{};  ///< why it failed
};

/// How an attempt is made.
struct AttemptOptions {
  const ActiveSet* branch = nullptr;  ///< smooth branch to stay on (Point::branch); null: that of y
  bool continuation = false;  ///< solve equations that Newton cannot by continuation in the step
};

/// A step from a consistent state to a consistent state. Holds no history that its solution depends
/// on, so that steps of any size follow each other.
class OneStepMethod {
public:
  virtual ~OneStepMethod() = default;
  /// Tries a step of size h; fills `to` (whole) on success.
  virtual Attempt attempt(const State& from, double h, const AttemptOptions& options,
                          State& to) = 0;
  /// `state` became the start of the next step; a kink there ends what can be extrapolated.
  virtual void accept(const State& state, bool kink) = 0;
  /// Dense output of the last attempt: about y at t [size].
  virtual void interpolate(double t, std::span<double> y) const = 0;

  /// What error estimates use of earlier steps: always equally many numbers.
  virtual std::vector<double> memory() const { return {}; }
  /// After accept() of the state at which it was that.
  virtual void restore(std::span<const double> /*memory*/) {}
};

}  // namespace gnomon
