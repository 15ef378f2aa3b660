// Preconditioner of the coupled Jacobian by its blocks (docs/linear.md).
#pragma once

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "linear/core_solver.hpp"
#include "linear/stiffness_block.hpp"

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
  BlockPreconditioner(const Structure& s, const InnerSolverMaker& inner)
      : structure_(required(s)),
        core_(!unknowns_of(s, {Role::friction}).empty() ? make_path_core(s, inner)
              : states_of(s) > 1                        ? make_compliance_core(s, inner)
                                                        : make_spring_core(s, inner)),
        mesh_motion_(s, Role::extension, inner),
        mesh_motion_row_(s, {Role::extension}, {Role::evolution}),
        multiplier_row_(s, {Role::reaction}, {Role::evolution, Role::extension}),
        multipliers_(unknowns_of(s, {Role::reaction})),
        work_(s.size) {}

  /// Takes the values of a new Jacobian, which must outlive their use. The inner solvers stay.
  void refresh(std::span<const double> J) {
    J_ = J;
    core_->refresh(J);
    mesh_motion_row_.refresh(J);
    multiplier_row_.refresh(J);
  }
  /// The cost of update(), in applications.
  double update_cost() const { return core_->update_cost(); }
  /// Includes the springs that have changed since the last set-up, without a new set-up.
  void update() { core_->update(); }
  /// Sets up the inner solvers for the Jacobian of refresh(); that of the mesh motion only if it is
  /// new or `whole`. Throws RecoverableError where a block is singular. Returns how many numeric
  /// factorizations were made.
  int set_up(bool whole) {
    int factorizations = core_->set_up(whole);
    if (whole || !mesh_motion_.is_set_up()) {
      mesh_motion_.gather(J_);
      factorizations += mesh_motion_.set_up("the stiffness of the mesh motion");
    }
    return factorizations;
  }
  /// The cost of setting up K_uu, in applications.
  double set_up_cost() const {
    if (const double cost = core_->set_up_cost(); cost > 0) return cost;
    return mesh_motion_.empty() ? 0 : mesh_motion_.solver().set_up_cost();
  }

  /// z = approximately J^-1 r [size]; z must not be r.
  void apply(std::span<const double> r, std::span<double> z) {
    std::copy(r.begin(), r.end(), work_.begin());
    std::fill(z.begin(), z.end(), 0.0);
    core_->solve(work_, z);
    mesh_motion_row_.subtract(z, work_);
    mesh_motion_.scatter(mesh_motion_.solve(work_), z);
    multiplier_row_.subtract(z, work_);
    for (int i : multipliers_) z[i] = work_[i] / J_[structure_.pattern.find(i, i)];
  }

private:
  static const Structure& required(const Structure& structure) {
    if (!structure.blocks || structure.position.empty())
      throw InputError("solver.method = \"block\": the system of this problem has no blocks");
    return structure;
  }
  /// Contact states: phases of a cycle.
  static std::size_t states_of(const Structure& structure) {
    std::set<int> owners;
    for (int i : unknowns_of(structure, {Role::stiffness}))
      owners.insert(structure.block_of(i).owner);
    return owners.size();
  }

  const Structure& structure_;
  std::span<const double> J_;
  std::unique_ptr<CoreSolver> core_;
  StiffnessBlock mesh_motion_;
  JacobianBlock mesh_motion_row_, multiplier_row_;
  std::vector<int> multipliers_;
  std::vector<double> work_;
};

}  // namespace gnomon
