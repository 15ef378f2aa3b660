// Contact states along a path, where friction may stick: phases of a cycle that depend on the ones
// before them.

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <memory>
#include <span>
#include <vector>

#include "linear/contact_compliance.hpp"
#include "linear/core_solver.hpp"
#include "linear/dense_products.hpp"
#include "linear/path_blocks.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

namespace {

/// Solves J z = r in the unknowns u_p (displacements), y_p (multipliers of closed nodes, normal and
/// tangential, and rigid motions) of the phases p, and g (shape of the worn surface, and memory);
/// what follows from them, as the places on the partner of a pair, is put in (PathBlocks). Indices
/// of J are rows and columns; J_ug is neglected. K is the mean stiffness of the phases, and the
/// only matrix that is factorized: multipliers press nodes, but make no springs (StickTerm).
///
/// With u_p = K^-1 (r_u,p - J_uy y_p) = x_p - K^-1 J_uy y_p, of which only the displacements of
/// contact nodes enter (ContactCompliance), the rows of y and g are
///
///   A_p y_p + F_p y_(p-1) + G_p g = f_p,     sum_p H_p y_p + J_gg g = q
///   A_p = J_yy - J_yu K^-1 J_uy,             f_p = r_y - J_yu x_p - J_y,u(p-1) x_(p-1)
///   F_p, H_p: the same of the phase before, and of the rows of g
///
/// where soft springs hold bodies of pairs (compliance_core.cpp): block-bidiagonal in the phases,
/// with a border: one pass along the path eliminates y for all columns of G, a small dense matrix
/// is left for g, and two solves with K make an application.
class PathCore : public CoreSolver {
public:
  /// `structure` must outlive the object; throws as StiffnessBlock.
  PathCore(const Structure& structure, const InnerSolverMaker& inner)
      : column_cost_(inner.column_cost),
        stiffness_(structure, Role::stiffness, inner),
        blocks_(structure, stiffness_),
        phases_(stiffness_.owners()),
        compliance_(blocks_.points()),
        contact_columns_(structure, {Role::stiffness, Role::rigid},
                         {Role::multiplier, Role::friction, Role::rigid}),
        following_rows_(structure, {Role::multiplier, Role::friction},
                        {Role::stiffness, Role::evolution, Role::memory}),
        slow_rows_(structure, {Role::evolution, Role::memory},
                   {Role::stiffness, Role::multiplier, Role::friction, Role::rigid}),
        contact_(structure.size) {}

  void refresh(std::span<const double> J) override {
    J_ = J;
    blocks_.refresh(J);
    for (JacobianBlock* block : {&contact_columns_, &following_rows_, &slow_rows_})
      block->refresh(J);
  }
  double update_cost() const override {
    return in_applications(column_cost_ *
                           static_cast<double>(compliance_.missing(blocks_.touched())));
  }
  void update() override {
    compliance_.solve(blocks_.touched(), stiffness_);
    blocks_.gather();
    eliminate();
  }
  int set_up(bool) override {
    stiffness_.gather(J_);
    // A body that multipliers press may have no other support.
    if (blocks_.has_partners()) stiffness_.add_soft_springs();
    const int factorizations = stiffness_.set_up("the stiffness of the body");
    compliance_.clear();
    update();
    return factorizations;
  }
  double set_up_cost() const override {
    return in_applications(column_cost_ * static_cast<double>(compliance_.columns()) +
                           stiffness_.solver().set_up_cost());
  }

  void solve(std::span<double> s, std::span<double> z) override {
    solve_open(s, z);
    stiffness_.scatter(stiffness_.solve(s), z);
    solve_contact(s, z);
    std::fill(contact_.begin(), contact_.end(), 0.0);
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      const std::vector<int>& y = blocks_.phases()[p].y;
      for (std::size_t k = 0; k < y.size(); ++k) contact_[y[k]] = phases_[p].solution[long(k)];
    }
    contact_columns_.subtract(contact_, s);
    stiffness_.scatter(stiffness_.solve(s), z);
    for (const PathBlocks::Phase& phase : blocks_.phases())
      for (const int i : phase.y) z[i] = contact_[i];
    solve_slow(s, z);
  }

private:
  /// Of the current J.
  struct Phase {
    Eigen::MatrixXd moved;  ///< v by y, with the sign of a force
    Eigen::PartialPivLU<Eigen::MatrixXd> A;
    Eigen::MatrixXd F, H, Z;  ///< Z: y by g
    Eigen::VectorXd solution;
  };

  double in_applications(double solves) const {
    return solves / (1 + 2 * column_cost_ * static_cast<double>(stiffness_.owners()));
  }

  /// A, F, H, the y of unit g along the path, and the matrix of g.
  void eliminate() {
    const Eigen::MatrixXd G = compliance_.among(blocks_.touched());
    Eigen::MatrixXd rest = blocks_.g_by_g();
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      const PathBlocks::Phase& of = blocks_.phases()[p];
      Phase& phase = phases_[p];
      phase.moved = G * of.v_by_y;
      Eigen::MatrixXd A = of.y_by_y - of.y_by_v * phase.moved;
      for (Eigen::Index k = 0; k < A.cols(); ++k)  // a rigid motion that nothing touches
        if (A.col(k).isZero(0) || A.row(k).isZero(0)) A(k, k) = 1;
      phase.A.compute(A);
      phase.H = of.g_by_y - of.g_by_v * phase.moved;
      Eigen::MatrixXd right = of.y_by_g;
      if (p > 0) {
        phase.F = of.y_by_y_before - of.y_by_before * phases_[p - 1].moved;
        subtract_product(phase.F, phases_[p - 1].Z, right);
      }
      phase.Z = gnomon::solve(phase.A, right);
      subtract_product(phase.H, phase.Z, rest);
    }
    if (rest.size() > 0) rest_.compute(rest);
  }

  /// Rows without other unknowns: open nodes, and what follows, without its v and g.
  void solve_open(std::span<double> s, std::span<double> z) const {
    for (const PathBlocks::Phase& phase : blocks_.phases())
      for (const int i : phase.all_y)
        if (blocks_.follows(i) || blocks_.number(i) < 0) {
          const double own = blocks_.own(i);
          z[i] = own == 0 ? s[i] : s[i] / own;
        }
    contact_columns_.subtract(z, s);
  }

  static Eigen::VectorXd of(std::span<const double> values, const std::vector<int>& unknowns) {
    Eigen::VectorXd result(std::ssize(unknowns));
    for (std::size_t k = 0; k < unknowns.size(); ++k) result[long(k)] = values[unknowns[k]];
    return result;
  }
  Eigen::VectorXd displacements(std::size_t p, std::span<const double> x) const {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(blocks_.v_size());
    for (const int i : blocks_.phases()[p].u)
      if (blocks_.number(i) >= 0) v[blocks_.number(i)] = x[i];
    return v;
  }

  /// y of all phases and g, from s and from the displacements without contact in x.
  void solve_contact(std::span<const double> s, std::span<const double> x) {
    Eigen::VectorXd q = of(s, blocks_.g()), v_before, e_before;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      const PathBlocks::Phase& by = blocks_.phases()[p];
      Phase& phase = phases_[p];
      const Eigen::VectorXd v = displacements(p, x), e = of(x, by.e);
      Eigen::VectorXd f = of(s, by.y) - by.y_by_v * v - by.y_by_e * e;
      if (p > 0)
        f -= by.y_by_before * v_before + by.y_by_e_before * e_before +
             phase.F * phases_[p - 1].solution;
      phase.solution = phase.A.solve(f);
      q -= by.g_by_v * v + by.g_by_e * e + phase.H * phase.solution;
      v_before = v;
      e_before = e;
    }
    slow_solution_ = q;
    if (q.size() > 0) slow_solution_ = rest_.solve(q);
    for (Phase& phase : phases_) phase.solution -= phase.Z * slow_solution_;
  }

  /// g of all points, and what follows: the memory of open nodes last.
  void solve_slow(std::span<double> s, std::span<double> z) const {
    const auto solve_row = [&](int i) { z[i] = s[i] / blocks_.own(i); };
    for (const int i : blocks_.slow())
      if (blocks_.number(i) >= 0)
        z[i] = slow_solution_[blocks_.number(i)];
      else
        solve_row(i);
    following_rows_.subtract(z, s);
    for (const PathBlocks::Phase& phase : blocks_.phases())
      for (const int i : phase.all_y)
        if (blocks_.follows(i)) solve_row(i);
    slow_rows_.subtract(z, s);
    for (const int i : blocks_.slow())
      if (blocks_.number(i) < 0) solve_row(i);
  }

  std::span<const double> J_;
  const double column_cost_;  // in solves with K
  StiffnessBlock stiffness_;
  PathBlocks blocks_;
  std::vector<Phase> phases_;
  ContactCompliance compliance_;
  Eigen::PartialPivLU<Eigen::MatrixXd> rest_;  // of g, without y
  Eigen::VectorXd slow_solution_;
  JacobianBlock contact_columns_, following_rows_, slow_rows_;
  std::vector<double> contact_;  // y of all phases, of the system's size
};

}  // namespace

std::unique_ptr<CoreSolver> make_path_core(const Structure& structure,
                                           const InnerSolverMaker& inner) {
  return std::make_unique<PathCore>(structure, inner);
}

}  // namespace gnomon
