// Decides during a run which states are stored, at which times steps have to end, and when it ends
// before time.end: where an observation passes a value.
#pragma once

#include <gnomon/model/observation.hpp>
#include <gnomon/run/run.hpp>

namespace gnomon {

class StoreSchedule {
public:
  StoreSchedule(const StorePolicy& policy, double end) : policy_(policy), end_(end) {}

  /// The next time at which a step has to end.
  double stop() const { return next_ < policy_.times.size() ? policy_.times[next_] : end_; }

  /// Whether the state at `t`, reached by step number `step`, is to be stored.
  bool wants(double t, long step) {
    bool wanted = policy_.every > 0 && step % policy_.every == 0;
    while (next_ < policy_.times.size() && t >= policy_.times[next_]) {
      wanted = true;
      ++next_;
    }
    return wanted || t >= end_;
  }

private:
  StorePolicy policy_;
  double end_;
  std::size_t next_ = 0;  // of policy_.times
};

/// Negative before the end, in the unit of the observation. Throws InputError if there is no such
/// observation.
double excess(const Until& until, const Observation& observed);

/// Of an observation that changes evenly from `before` (negative) to `after`, or jumps, as a number
/// of nodes does (then the middle): the part of the step at which the run ends, or 1 if the step
/// ends there or shortly behind: by a thousandth of `steps` times the step.
double part_until(double before, double after, double steps);

}  // namespace gnomon
