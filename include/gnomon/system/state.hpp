// A point of the solution.
#pragma once

#include <gnomon/system/system.hpp>
#include <vector>

namespace gnomon {

/// A consistent point of the DAE. y and ydot have system().size() entries; ydot is meaningful for
/// the differential components only and zero elsewhere.
struct State {
  double t = 0;
  std::vector<double> y;
  std::vector<double> ydot;
  /// The smooth branch on which it was solved, if events are located: at an event a node may be on
  /// the other side because of rounding. Empty: the branch that y lies in.
  ActiveSet branch = {};

  /// In the form of Point::branch.
  const ActiveSet* own_branch() const { return branch.empty() ? nullptr : &branch; }
};

}  // namespace gnomon
