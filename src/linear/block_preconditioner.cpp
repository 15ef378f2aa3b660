#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/block_preconditioner.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <set>

#include "linear/core_solver.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

namespace {

/// Contact states: phases of a cycle.
std::size_t states_of(const Structure& structure) {
  std::set<int> owners;
  for (int i : unknowns_of(structure, {Role::stiffness}))
    owners.insert(structure.blocks[structure.block[i]].owner);
  return owners.size();
}

std::unique_ptr<CoreSolver> make_core(const Structure& structure, const InnerSolverMaker& inner) {
  return states_of(structure) > 1 ? make_compliance_core(structure, inner)
                                  : make_spring_core(structure, inner);
}

}  // namespace

struct BlockPreconditioner::Blocks {
  const Structure& structure;
  std::span<const double> J;
  std::unique_ptr<CoreSolver> core;
  StiffnessBlock mesh_motion;
  JacobianBlock mesh_motion_row, multiplier_row;
  std::vector<int> multipliers;
  std::vector<double> work;

  Blocks(const Structure& s, const InnerSolverMaker& inner)
      : structure(s),
        core(make_core(s, inner)),
        mesh_motion(s, Role::extension, true, inner),
        mesh_motion_row(s, {Role::extension}, {Role::evolution}),
        multiplier_row(s, {Role::reaction}, {Role::evolution, Role::extension}),
        multipliers(unknowns_of(s, {Role::reaction})),
        work(s.size) {}

  double diagonal(int i) const { return J[structure.pattern.find(i, i)]; }
};

BlockPreconditioner::BlockPreconditioner(const Structure& structure,
                                         const InnerSolverMaker& inner) {
  if (structure.blocks.empty() || structure.position.empty())
    throw InputError("solver.method = \"block\": the system of this problem has no blocks");
  blocks_ = std::make_unique<Blocks>(structure, inner);
}
BlockPreconditioner::~BlockPreconditioner() = default;

void BlockPreconditioner::refresh(std::span<const double> J) {
  blocks_->J = J;
  blocks_->core->refresh(J);
}

double BlockPreconditioner::update_cost() const {
  return blocks_->core->update_cost();
}

void BlockPreconditioner::update() {
  blocks_->core->update();
}

int BlockPreconditioner::set_up(bool whole) {
  Blocks& b = *blocks_;
  int factorizations = b.core->set_up(whole);
  if (whole || !b.mesh_motion.is_set_up()) {
    b.mesh_motion.gather(b.J);
    factorizations += b.mesh_motion.set_up("the stiffness of the mesh motion");
  }
  return factorizations;
}

double BlockPreconditioner::set_up_cost() const {
  if (const double cost = blocks_->core->set_up_cost(); cost > 0) return cost;
  return blocks_->mesh_motion.empty() ? 0 : blocks_->mesh_motion.solver().set_up_cost();
}

void BlockPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  Blocks& b = *blocks_;
  std::copy(r.begin(), r.end(), b.work.begin());
  std::fill(z.begin(), z.end(), 0.0);
  b.core->solve(b.work, z);
  b.mesh_motion_row.subtract(b.J, z, b.work);
  b.mesh_motion.scatter(b.mesh_motion.solve(b.work), z);
  b.multiplier_row.subtract(b.J, z, b.work);
  for (int i : b.multipliers) z[i] = b.work[i] / b.diagonal(i);
}

}  // namespace gnomon
