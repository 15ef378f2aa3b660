// The branch of the steps of IDA while events are located by its roots.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Nodes switch where IDA finds a root of their switching function, or where they are found on the
/// other side of it.
class RootBranch {
public:
  /// `end`: of the run.
  RootBranch(const System& system, double t, std::span<const double> y, double end)
      : system_(&system),
        end_(end),
        active_(active_set(system, t, y)),
        switched_at_(active_.size(), -end) {}

  /// Goes on with a system that has the same switching functions.
  void adopt(const System& system) { system_ = &system; }

  const ActiveSet& active() const { return active_; }
  int size() const { return static_cast<int>(active_.size()); }

  /// Switches the nodes at t and returns how many. `roots`: what IDAGetRootInfo gives, an entry per
  /// node; null if the step has not ended at a root.
  /// The node that IDA names, and nodes that switch with it because of symmetry but whose roots
  /// differ by rounding. A node that has just switched starts from zero with a sign that is
  /// determined by rounding, and may reach its new branch by a root: it is not switched again.
  int switch_nodes(double t, std::span<const double> y, const std::vector<int>* roots) {
    // Relative to the largest switching function: symmetric nodes differ by the residual of
    // Newton's method, up to NewtonOptions::acceptable.
    constexpr double together = 1e-9;
    // Part of the run before a node may switch again. After an event IDA begins at order one, with
    // a step of at most 1e-3 of the time to t_stop: an event earlier than this is below the error
    // of that step.
    constexpr double moment = 1e-6;
    std::vector<double> values(active_.size());
    system_->switching({.t = t, .y = y}, values);
    double largest = 0;
    for (double value : values) largest = std::max(largest, std::abs(value));
    int switched = 0;
    for (std::size_t j = 0; j < active_.size(); ++j) {
      if (t - switched_at_[j] <= moment * end_) continue;
      const int found = roots ? (*roots)[j] : 0;
      const bool rooted = found != 0 && (found < 0) != bool(active_[j]);
      if (found != 0 && !rooted) continue;
      const bool off = (values[j] <= 0) != bool(active_[j]);
      const bool beside = roots && std::abs(values[j]) <= together * largest;
      if (!rooted && !off && !beside) continue;
      active_[j] = !active_[j];
      switched_at_[j] = t;
      ++switched;
    }
    return switched;
  }

private:
  const System* system_;
  double end_;
  ActiveSet active_;
  std::vector<double> switched_at_;  // time of each node's last event
};

}  // namespace gnomon
