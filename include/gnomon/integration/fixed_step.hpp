// Fixed steps with halving after a failed solve, as the paper's substepping.
#pragma once

#include <functional>
#include <string>

#include <gnomon/integrator.hpp>

namespace gnomon {

/// Outcome of one attempt at a step.
struct Attempt {
  bool success = false;
  std::string reason;  ///< why it failed
};

/// Steps on the grid t_0 + k step. An attempt that fails is counted as rejected and repeated with
/// half the step; after a success the step doubles until it is back on the grid.
class FixedStepper : public Stepper {
public:
  /// Tries a step of size h from `state`; fills `next` (whole) on success.
  using Try = std::function<Attempt(const State& state, double h, State& next)>;

  FixedStepper(int order, const IntegratorSettings& settings, Counters& counters, Try attempt);
  StepReport advance(State& state, double t_stop) override;

private:
  int order_;
  double step_;     // nominal
  double substep_;  // what is tried next, <= step_
  Counters& counters_;
  Try attempt_;
  State next_;
};

/// Rates of the differential components: every differential row is ydot + f(t, y) = 0, so they are
/// minus the row at ydot = 0. Fills ydot, zero elsewhere.
void set_rates(const System& system, State& state);

}  // namespace gnomon
