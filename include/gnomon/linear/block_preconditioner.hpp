// Preconditioner of the coupled Jacobian by its blocks (docs/linear.md).
#pragma once

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>

namespace gnomon {

/// Solves J z = r approximately, block by block: the rows of worn surface and contact turn the
/// contact nodes into springs on K_uu (the wear of a step is a compliance), K_uu with springs is
/// solved, the scalar rigid motion is bordered, then multipliers, worn surface, mesh motion and
/// shape multipliers follow. The derivative of equilibrium with respect to the shape is neglected.
/// Blocks that a system lacks are skipped, so the stages of a system are solved by the same code.
class BlockPreconditioner {
public:
  /// Blocks by the roles of `structure.blocks`. Throws InputError where a system has no blocks or
  /// multigrid is not built in. `structure` must outlive the object.
  BlockPreconditioner(const Structure& structure, const InnerSolverMaker& inner);
  ~BlockPreconditioner();

  /// Takes the values of a new Jacobian, which must outlive their use. The inner solvers stay.
  void refresh(std::span<const double> J);
  /// The cost of update(), in applications.
  double update_cost() const;
  /// Includes the springs that have changed since the last set-up, without a new set-up.
  void update();
  /// Sets up the inner solvers for the Jacobian of refresh(); that of the mesh motion only if it is
  /// new or `whole`. Throws RecoverableError where a block is singular. Returns how many numeric
  /// factorizations were made.
  int set_up(bool whole);
  /// The cost of setting up K_uu, in applications.
  double set_up_cost() const;

  /// z = approximately J^-1 r [size]; z must not be r.
  void apply(std::span<const double> r, std::span<double> z);

private:
  struct Blocks;
  std::unique_ptr<Blocks> blocks_;
};

}  // namespace gnomon
