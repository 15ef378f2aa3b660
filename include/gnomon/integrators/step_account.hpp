// The attempts of one step, in the counters of the run.
#pragma once

#include <gnomon/base/counters.hpp>

namespace gnomon {

/// Made when a step begins.
class StepAccount {
public:
  explicit StepAccount(Counters& counters)
      : counters_(counters), newton_before_(counters.newton_iterations) {}

  /// An attempt was rejected.
  void reject() { ++counters_.rejected_steps; }
  /// Newton iterations since the step began.
  long newton_iterations() const { return counters_.newton_iterations - newton_before_; }

private:
  Counters& counters_;
  long newton_before_;
};

}  // namespace gnomon
