// Whether nodes have come into contact in the last steps.
#pragma once

#include <algorithm>
#include <gnomon/base/processes.hpp>
#include <gnomon/system/system.hpp>
#include <utility>

namespace gnomon {

/// Counts the accepted steps since a contact node last closed. Such a node protrudes, because the
/// stages before it closed did not wear it; later steps of a method that damps stiff components
/// take that away (Settling in stop_times.hpp).
class Closings {
public:
  /// A closing is recent for this number of accepted steps.
  explicit Closings(int steps) : steps_(steps), since_(steps) {}

  /// The active set of the state from which the next step starts.
  void begin(ActiveSet start) { active_ = std::move(start); }
  /// Whether a node that is open at the start of the step is closed at its end.
  bool closes(const ActiveSet& end) const {
    bool none = true;
    for (std::size_t j = 0; j < end.size(); ++j) none = none && (active_[j] || !end[j]);
    return !on_all_processes(none);
  }
  /// The step was accepted. `settled`: it has damped the closings before it.
  void accept(ActiveSet end, bool settled) {
    const int before = settled ? steps_ : std::min(since_ + 1, steps_);
    since_ = closes(end) ? 0 : before;
    active_ = std::move(end);
  }
  bool recent() const { return since_ < steps_; }

  /// For a checkpoint, with begin().
  double memory() const { return since_; }
  void restore(double since) { since_ = static_cast<int>(since); }

private:
  int steps_;
  int since_;  // at most steps_
  ActiveSet active_;
};

}  // namespace gnomon
