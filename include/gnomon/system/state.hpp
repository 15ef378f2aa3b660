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
  /// The smooth branch that it was solved on, where events are located: at an event a node may be
  /// on the other side by rounding. Empty: the one that y lies in.
  ActiveSet branch = {};

  /// As Point::branch wants it.
  const ActiveSet* own_branch() const { return branch.empty() ? nullptr : &branch; }
};

}  // namespace gnomon
