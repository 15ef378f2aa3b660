// Points of the solution.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace gnomon {

struct SlowPart;  // system.hpp
struct Structure;
class System;

/// One entry per switching function (for contact: 1 where the node is closed).
using ActiveSet = std::vector<char>;

/// The point at which a system is evaluated.
struct Point {
  double t = 0;
  std::span<const double> y;
  std::span<const double> ydot = {};  ///< not read by purely algebraic systems
  /// The smooth branch to evaluate, continued beyond its border (gaps of open nodes may be
  /// negative, multipliers of closed ones positive). Null: the branch that y lies in.
  const ActiveSet* branch = nullptr;
  /// F is taken from the smooth part in time that follows this time (up to the next breakpoint),
  /// continued to t: the start of a step that has a stage past its end. Absent: t itself.
  std::optional<double> within = {};
  /// Read by jacobian() alone: if the slow part is known, `values` must be those of the last call
  /// with it, and their slow part is kept unless y is too far away; otherwise it becomes known.
  /// A system that has no slow part ignores it. Null: all of J is that of this point.
  SlowPart* slow = nullptr;
  /// Read by residual() alone: the rates are asked for, and other rows of F may be left incomplete.
  bool rates_only = false;
};

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
