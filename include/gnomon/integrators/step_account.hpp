// The account of one step: what it reports, and what it adds to the counters of the run.
#pragma once

#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

/// Made where a step begins; every driver counts its attempts by one.
class StepAccount {
public:
  explicit StepAccount(Counters& counters)
      : counters_(counters), newton_before_(counters.newton_iterations) {}

  /// So many attempts were thrown away.
  void reject(long attempts = 1) {
    counters_.rejected_steps += attempts;
    rejected_ = rejected_ || attempts > 0;
  }
  /// Since the step began.
  long newton_iterations() const { return counters_.newton_iterations - newton_before_; }
  /// The step is made.
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
