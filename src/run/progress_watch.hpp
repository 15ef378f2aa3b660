// Ends a run for lack of progress: every step succeeds, but needs ever more work for ever less
// time.
#pragma once

#include <gnomon/base/counters.hpp>

namespace gnomon {

class ProgressWatch {
public:
  /// For a run that is at t, has done this work and ends at `end` [time].
  ProgressWatch(double t, const Counters& counters, double end);
  /// Called after every step. Throws SolutionError when the last most_newton_iterations
  /// (integrators/stop_rules.hpp) have advanced the run by less than 1e-5 of its length: at that
  /// rate the whole run would take 5e8 iterations, that is six days at a millisecond each.
  void require(double t, const Counters& counters);

private:
  double t_;                // time at which the present count of iterations began
  long newton_iterations_;  // counted by then
  double end_;
};

}  // namespace gnomon
