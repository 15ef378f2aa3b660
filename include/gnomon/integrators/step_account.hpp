// The account of one step: its report, and its share in the counters of the run.
#pragma once

#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

/// Made when a step begins; every driver counts its attempts with such an object.
class StepAccount {
public:
  explicit StepAccount(Counters& counters)
      : counters_(counters), newton_before_(counters.newton_iterations) {}

  /// This number of attempts was rejected.
  void reject(long attempts = 1) {
    counters_.rejected_steps += attempts;
    rejected_ = rejected_ || attempts > 0;
  }
  /// Newton iterations since the step began.
  long newton_iterations() const { return counters_.newton_iterations - newton_before_; }
  /// The step is accepted.
  StepReport accept(double step, int order) {
    ++counters_.steps;
    return {.step = step,
            .order = order,
            .newton_iterations = newton_iterations(),
            .restarted = rejected_};
  }

private:
  Counters& counters_;
  long newton_before_;
  bool rejected_ = false;
};

}  // namespace gnomon
