// The branch of the steps of IDA while events are located by its roots.
#pragma once

#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Nodes switch where IDA finds a root of their switching function, or where they are found on the
/// other side of it.
class RootBranch {
public:
  /// `end`: of the run.
  RootBranch(const System& system, double t, std::span<const double> y, double end);

  /// Goes on with a system that has the same switching functions.
  void adopt(const System& system) { system_ = &system; }

  const ActiveSet& active() const { return active_; }
  int size() const { return static_cast<int>(active_.size()); }

  /// Switches the nodes at t and returns how many. `roots`: what IDAGetRootInfo gives, an entry per
  /// node; null if the step has not ended at a root.
  int switch_nodes(double t, std::span<const double> y, const std::vector<int>* roots);

private:
  const System* system_;
  double end_;
  ActiveSet active_;
  std::vector<double> switched_at_;  // time of each node's last event
};

}  // namespace gnomon
