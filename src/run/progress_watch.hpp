// Ends a run for lack of progress: every step succeeds, after ever more work and over ever less
// time.
#pragma once

#include <gnomon/base/counters.hpp>

namespace gnomon {

class ProgressWatch {
public:
  /// Of a run that is at t and has done this work; it is to end at `end` [time].
  ProgressWatch(double t, const Counters& counters, double end);
  /// To be called after every step. Throws SolutionError when the last most_newton_iterations
  /// (integrators/stop_rules.hpp) have advanced the run by less than 1e-5 of its length: at that
  /// rate the whole run would take 5e8 of them: six days at a millisecond each.
  void require(double t, const Counters& counters);

private:
  double t_;                // where the present count of iterations began
  long newton_iterations_;  // counted by then
  double end_;
};

}  // namespace gnomon
