#include <Eigen/LU>
#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/block_preconditioner.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/jacobian_block.hpp>

#include "linear/contact_elimination.hpp"

namespace gnomon {

namespace {

constexpr Roles core_roles = {Role::stiffness, Role::multiplier, Role::evolution};

std::unique_ptr<InnerSolver> make_inner(const StiffnessLayout& layout, const Structure& structure) {
  return structure.solver.preconditioner == LinearSolverChoice::Preconditioner::multigrid
             ? make_multigrid_solver(layout)
             : make_factor_solver(layout);
}

/// A symmetric diagonal block with its own solver; it may have no unknowns.
struct StiffnessBlock {
  std::vector<int> unknowns;
  SymmetricPart part;
  StiffnessLayout layout;
  std::unique_ptr<InnerSolver> solver;
  std::vector<double> values, b, x;
  bool is_set_up = false;

  StiffnessBlock(const Structure& structure, Role role)
      : unknowns(unknowns_of(structure, {role})),
        part(structure.pattern, unknowns),
        b(unknowns.size()),
        x(unknowns.size()) {
    if (unknowns.empty()) return;
    layout.lower = part.lower();
    layout.position = structure.position;
    layout.coarsening = structure.coarsening;
    for (int i : unknowns) {
      layout.group.push_back(structure.group[i]);
      layout.component.push_back(structure.component[i]);
    }
    solver = make_inner(layout, structure);
  }

  /// Set-up for `values`. Returns how many factorizations were made.
  int set_up(const char* what) {
    if (!solver) return 0;
    if (!solver->set_up(values)) throw RecoverableError(std::string(what) + " is singular");
    is_set_up = true;
    return solver->factorizations();
  }

  void solve(std::span<const double> s, std::span<double> z,
             const LowRankUpdate* change = nullptr) {
    if (!solver) return;
    for (std::size_t k = 0; k < unknowns.size(); ++k) b[k] = s[unknowns[k]];
    solver->apply(b, x);
    if (change) change->correct(x);
    for (std::size_t k = 0; k < unknowns.size(); ++k) z[unknowns[k]] = x[k];
  }
};

}  // namespace

struct BlockPreconditioner::Blocks {
  const Structure& structure;
  std::span<const double> J;
  const bool by_factors;
  StiffnessBlock stiffness, mesh_motion;
  ContactElimination contact;
  LowRankUpdate change;            // of the stiffness
  std::vector<RankOneTerm> terms;  // of which the change has to consist
  JacobianBlock mesh_motion_row, multiplier_row, rigid_row, rigid_column;
  std::vector<int> core, multipliers;
  std::vector<int> rigid;                      // w, one for each contact state
  bool bordered = false;                       // the two below belong to J and the set-up
  std::vector<std::vector<double>> border;     // core solutions for the columns of w
  Eigen::PartialPivLU<Eigen::MatrixXd> schur;  // of J_ww, the Schur complement
  std::vector<double> work;

  explicit Blocks(const Structure& s)
      : structure(s),
        by_factors(s.solver.preconditioner == LinearSolverChoice::Preconditioner::factor),
        stiffness(s, Role::stiffness),
        mesh_motion(s, Role::extension),
        contact(s, by_factors),
        mesh_motion_row(s, {Role::extension}, {Role::evolution}),
        multiplier_row(
            s, {Role::reaction},
            {Role::stiffness, Role::multiplier, Role::rigid, Role::evolution, Role::extension}),
        rigid_row(s, {Role::rigid}, core_roles),
        rigid_column(s, core_roles, {Role::rigid}),
        core(unknowns_of(s, core_roles)),
        multipliers(unknowns_of(s, {Role::reaction})),
        rigid(unknowns_of(s, {Role::rigid})),
        border(rigid.size(), std::vector<double>(s.size)),
        work(s.size) {}

  double diagonal(int i) const { return J[structure.pattern.find(i, i)]; }

  void update_change() {
    if (stiffness.solver)
      change.set(terms, *stiffness.solver, static_cast<long>(stiffness.unknowns.size()));
  }

  /// Solves the rows of u, lambda and c; s is changed.
  void solve_core(std::span<double> s, std::span<double> z) {
    contact.condense(s);
    stiffness.solve(s, z, &change);
    contact.recover(s, z);
  }

  /// Solves for a unit of each w: then z_core = -border, and `schur` is the Schur complement of
  /// J_ww.
  void make_border() {
    const auto count = static_cast<Eigen::Index>(rigid.size());
    Eigen::MatrixXd complement = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      std::vector<double>& column = border[static_cast<std::size_t>(k)];
      const int w = rigid[static_cast<std::size_t>(k)];
      std::fill(column.begin(), column.end(), 0.0);
      std::fill(work.begin(), work.end(), 0.0);
      column[w] = -1;
      rigid_column.subtract(J, column, work);
      column[w] = 0;
      solve_core(work, column);
      std::fill(work.begin(), work.end(), 0.0);
      rigid_row.subtract(J, column, work);
      for (Eigen::Index l = 0; l < count; ++l)
        complement(l, k) = work[rigid[static_cast<std::size_t>(l)]];
      complement(k, k) += diagonal(w);
      // Nothing carries the force: the outer iteration will fail.
      if (complement.col(k).isZero(0)) complement(k, k) = 1;
    }
    schur.compute(complement);
    bordered = true;
  }

  void solve_rigid(std::span<double> s, std::span<double> z) const {
    rigid_row.subtract(J, z, s);
    Eigen::VectorXd right(static_cast<Eigen::Index>(rigid.size()));
    for (std::size_t k = 0; k < rigid.size(); ++k)
      right[static_cast<Eigen::Index>(k)] = s[rigid[k]];
    const Eigen::VectorXd w = schur.solve(right);
    for (std::size_t k = 0; k < rigid.size(); ++k) {
      const double value = z[rigid[k]] = w[static_cast<Eigen::Index>(k)];
      for (int i : core) z[i] -= border[k][i] * value;
    }
  }
};

BlockPreconditioner::BlockPreconditioner(const Structure& structure) {
  if (structure.blocks.empty() || structure.position.empty())
    throw InputError("solver.method = \"block\": the system of this problem has no blocks");
  blocks_ = std::make_unique<Blocks>(structure);
}
BlockPreconditioner::~BlockPreconditioner() = default;

void BlockPreconditioner::refresh(std::span<const double> J) {
  blocks_->J = J;
  blocks_->contact.update(J);
  blocks_->terms = blocks_->contact.low_rank_terms(blocks_->stiffness.part);
  blocks_->bordered = false;
}

double BlockPreconditioner::update_cost() const {
  // Factors solve for many columns together.
  const double cost_of_a_column = blocks_->by_factors ? 0.25 : 1;
  return cost_of_a_column * static_cast<double>(blocks_->change.columns_to_solve(blocks_->terms));
}

void BlockPreconditioner::update() {
  blocks_->update_change();
}

int BlockPreconditioner::set_up(bool whole) {
  Blocks& b = *blocks_;
  b.stiffness.part.gather(b.J, b.stiffness.values);
  b.contact.add_springs(b.stiffness.part, b.stiffness.values);
  b.terms = b.contact.low_rank_terms(b.stiffness.part);  // common wear alone
  // With multigrid the columns cost more than the set-up: they are kept until fresh ones are
  // needed.
  if (b.by_factors || whole) b.change.clear();
  int factorizations = b.stiffness.set_up("the stiffness of the body");
  b.update_change();
  if (whole || !b.mesh_motion.is_set_up) {
    b.mesh_motion.part.gather(b.J, b.mesh_motion.values);
    factorizations += b.mesh_motion.set_up("the stiffness of the mesh motion");
  }
  b.bordered = false;
  return factorizations;
}

double BlockPreconditioner::set_up_cost() const {
  const StiffnessBlock& largest =
      blocks_->stiffness.solver ? blocks_->stiffness : blocks_->mesh_motion;
  return largest.solver ? largest.solver->set_up_cost() : 0;
}

void BlockPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  Blocks& b = *blocks_;
  if (!b.rigid.empty() && !b.bordered) b.make_border();
  std::copy(r.begin(), r.end(), b.work.begin());
  std::fill(z.begin(), z.end(), 0.0);
  b.solve_core(b.work, z);
  if (!b.rigid.empty()) b.solve_rigid(b.work, z);
  b.mesh_motion_row.subtract(b.J, z, b.work);
  b.mesh_motion.solve(b.work, z);
  b.multiplier_row.subtract(b.J, z, b.work);
  for (int i : b.multipliers) z[i] = b.work[i] / b.diagonal(i);
}

}  // namespace gnomon
