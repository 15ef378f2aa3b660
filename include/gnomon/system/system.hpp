// The interface of all systems to time integration methods (docs/equations.md):
//
//   F(t, y, ydot) = 0,   J = dF/dy + alpha dF/dydot,
//
// whose differential rows are ydot_i + f_i(t, y) = 0 (row i belongs to unknown i) and whose other
// rows do not contain ydot. An index-1 differential-algebraic system, semismooth in y.
#pragma once

#include <array>
#include <functional>
#include <gnomon/fields/sparse_pattern.hpp>
#include <gnomon/mesh/node_interpolation.hpp>
#include <gnomon/system/linear_solver.hpp>
#include <gnomon/system/state.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon {

struct Block;  // fields/block.hpp

/// Sizes and constants of a system that do not change during a run.
struct Structure {
  long size = 0;
  SparsePattern pattern = {};   ///< of J, the union over all states
  std::vector<int> group = {};  ///< size entries: rows of one node share a number (ordering)
  std::vector<char> differential = {};       ///< size entries: 1 where ydot enters F
  std::vector<double> tolerance_scale = {};  ///< size entries, as in Block; empty: 1
  /// Algebraic unknowns whose solution depends on where they come from, ascending: an algebraic
  /// stage is solved from their values at the last state, not from guesses.
  std::vector<int> remembered = {};
  std::vector<double> row_scale = {};  ///< size entries: magnitude of F_i, in the unit of the row
  std::vector<double> unknown_scale = {};  ///< size entries: typical |y_i|
  std::vector<int> switch_node = {};  ///< one per switching function: the mesh node it belongs to
  /// One per switching function: 1 where rates may jump when it changes its sign; empty: nowhere.
  std::vector<char> switch_jumps = {};
  std::vector<double> breakpoints = {};  ///< ascending times at which F may have a kink in t
  /// Ascending times, beside the breakpoints, at which steps that follow the error shall end: what
  /// F does for a short time, smoothly in t, would be stepped over.
  std::vector<double> stops = {};
  LinearSolverMaker solver = {};  ///< factors where it makes none
  // For solvers by blocks; empty where a system has no such blocks.
  std::shared_ptr<const std::vector<Block>> blocks = {};
  std::vector<int> block = {};       ///< size entries: in `blocks`
  std::vector<char> component = {};  ///< size entries: 0, 1, 2 of a vector, else 0
  /// Of a `group`, initial configuration [length].
  std::vector<std::array<double, 3>> position = {};
  /// Of the mesh, for geometric multigrid; null or empty where it is not needed or not possible.
  std::shared_ptr<const std::vector<NodeInterpolation>> coarsening = {};

  /// The block of an unknown, if there are blocks.
  const Block& block_of(std::size_t unknown) const;
};

/// The part of a Jacobian that changes slowly with the state and is expensive, such as the
/// derivatives of the cells of a body. It stays in the array of values; kept here are its entries
/// to which other parts add, then y. One object for one array.
struct SlowPart {
  bool known = false;
  std::vector<double> values;
};

struct AlgebraicStage;

/// The equations that every integrator sees. Five members, no defaults.
class System {
public:
  virtual ~System() = default;

  virtual const Structure& structure() const = 0;

  /// F [size]. Throws RecoverableError where the state has no residual (inverted element).
  virtual void residual(const Point& at, std::span<double> F) const = 0;

  /// Values of J on structure().pattern, overwritten. Same errors as residual().
  virtual void jacobian(const Point& at, double alpha, std::span<double> values) const = 0;

  /// One value per switching function, smooth in y, negative or zero where it is active (the
  /// augmented multiplier). Two points whose values have equal signs share one smooth residual.
  virtual void switching(const Point& at, std::span<double> values) const = 0;

  /// The algebraic rows for given differential components, as a sequence of smaller systems to be
  /// solved one after the other (Remark 1: mesh motion, then contact). The caller owns them.
  virtual std::vector<AlgebraicStage> algebraic_stages() const = 0;
};

/// An algebraic stage: a system for some unknowns of a parent system, with the others and the time
/// frozen.
struct AlgebraicStage {
  std::vector<int> unknowns;       ///< position in the parent's y of each unknown of `system`
  std::unique_ptr<System> system;  ///< purely algebraic; t and ydot do not enter
  /// Freezes time and the other unknowns at the parent's t and y.
  std::function<void(double t, std::span<const double> y)> freeze;
};

/// The branch that a point lies in.
ActiveSet active_set(const System& system, const Point& at);
ActiveSet active_set(const System& system, double t, std::span<const double> y);

}  // namespace gnomon
