// Several contact states at one shape: phases of a cycle.

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/contact_compliance.hpp"
#include "linear/core_solver.hpp"
#include "linear/factored_block.hpp"
#include "linear/phase_contact.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

namespace {

/// Solves J z = r in the unknowns u_p (displacements), l_p (contact multipliers of closed nodes)
/// and w_p (rigid motions) of the phases p, and c (shape of the worn surfaces), which alone couples
/// them. Indices of J are rows and columns; J_uc is neglected, J_wc too, and of J_cc only the block
/// of each surface node counts but where c is recovered. K is the mean stiffness of the phases, the
/// same for all with small strains, and the only matrix that is factorized.
///
/// What all phases wear off a surface node has one direction m: dc = J_cc^-1 (r_c - m zeta), with
///
///   zeta = m . sum_p (J_cl dl_p + J_cu du_p + J_cw dw_p)
///
/// The displacements follow from those without contact, x_p, and from y_p = (dl_p, dw_p):
///
///   x_p = K^-1 r_u,p,     du_p = x_p - K^-1 (J_ul, J_uw) y_p
///
/// Put into the rows of l and w, with a = J_lc J_cc^-1, this leaves a small dense system per phase,
/// to which K contributes only its compliance at the nodes that touch (ContactCompliance):
///
///   A_p y_p - (a.m) zeta = f_p,   f_l = r_l - a r_c - J_lu x_p,   f_w = r_w - J_wu x_p
///   A_p = J_yy - J_yu K^-1 J_uy
///   zeta = sum_p V_p y_p + q,     V_p = m.J_cy - m.J_cu K^-1 J_uy,   q = sum_p m.J_cu x_p
///
/// and one for what is worn: (1 - sum_p V_p A_p^-1 (a.m)) zeta = sum_p V_p A_p^-1 f_p + q. Two
/// solves with K, all phases as columns, thus make an application, whatever nodes touch.
///
/// Where bodies meet each other, l also presses and wears the nodes of another body. A body that
/// contact alone holds has a singular stiffness: soft springs hold each node, which A_p, where
/// contact is closed, does not feel.
class ComplianceCore : public CoreSolver {
public:
  /// `structure` must outlive the object; throws as StiffnessBlock.
  ComplianceCore(const Structure& structure, const InnerSolverMaker& inner)
      : structure_(structure),
        column_cost_(inner.column_cost),
        stiffness_(structure, Role::stiffness, inner),
        contacts_(structure, stiffness_.owners()),
        compliance_(numbers_in_block(contacts_.phases(), stiffness_)),
        systems_(stiffness_.owners()),
        may_float_(contacts_.have_partners()),
        contact_columns_(structure, {Role::stiffness, Role::evolution, Role::rigid},
                         {Role::multiplier, Role::rigid}),
        wear_by_displacement_(structure, {Role::evolution}, {Role::stiffness}),
        wear_block_(structure, {Role::evolution}),
        contact_(structure.size) {}

  void refresh(std::span<const double> J) override {
    J_ = J;
    contacts_.update(J);
    wear_block_.factorize(J);
    contact_columns_.refresh(J);
    wear_by_displacement_.refresh(J);
  }
  double update_cost() const override {
    const auto missing = static_cast<double>(compliance_.missing(contacts_.touched()));
    return in_applications(column_cost_ * missing);
  }

  void update() override {
    compliance_.solve(contacts_.touched(), stiffness_);
    const long count = static_cast<long>(systems_.size()), columns = compliance_.columns();
    divide_among_threads(count, count * columns * columns, [this](long p) { make_system(p); });
    Eigen::MatrixXd wear = Eigen::MatrixXd::Identity(contacts_.worn(), contacts_.worn());
    for (std::size_t p = 0; p < systems_.size(); ++p) {
      const std::vector<int>& worn = contacts_.phases()[p].worn;
      wear(worn, worn) -= systems_[p].fed_back;
    }
    if (wear.size() > 0) wear_.compute(wear);
    right_of_wear_.resize(wear.rows());
  }

  int set_up(bool) override {
    stiffness_.gather(J_);
    if (may_float_) stiffness_.add_soft_springs();
    const int factorizations = stiffness_.set_up("the stiffness of the body");
    compliance_.clear();
    update();
    return factorizations;
  }
  double set_up_cost() const override {
    const auto columns = static_cast<double>(compliance_.columns());
    return in_applications(column_cost_ * columns + stiffness_.solver().set_up_cost());
  }

  void solve(std::span<double> s, std::span<double> z) override {
    solve_open(s, z);
    stiffness_.scatter(stiffness_.solve(s), z);
    make_right_sides(s, z);
    solve_contact();
    contact_columns_.subtract(contact_, s);
    stiffness_.scatter(stiffness_.solve(s), z);
    for (const PhaseContact& phase : contacts_.phases())
      for (int i : phase.y) z[i] = contact_[i];
    wear_by_displacement_.subtract(z, s);
    wear_block_.solve(s, z);
  }

private:
  /// A point belongs to the phases in which a contact node may move it.
  static std::vector<NodeUnknowns> numbers_in_block(const std::vector<PhaseContact>& phases,
                                                    const StiffnessBlock& stiffness) {
    std::vector<NodeUnknowns> numbers(phases.front().u.size(), {-1, -1, -1});
    for (std::size_t p = 0; p < phases.size(); ++p)
      for (std::size_t k = 0; k < numbers.size(); ++k)
        for (int i = 0; i < most_components; ++i)
          if (const int u = phases[p].u[k][i]; u >= 0) {
            const std::vector<int>& block = stiffness.unknowns(p);
            numbers[k][i] = static_cast<int>(std::ranges::lower_bound(block, u) - block.begin());
          }
    return numbers;
  }
  struct PhaseSystem {
    Eigen::PartialPivLU<Eigen::MatrixXd> A;
    Eigen::MatrixXd wear;      ///< V
    Eigen::MatrixXd fed_back;  ///< V A^-1 (a.m)
    Eigen::VectorXd right;     ///< f
  };
  double in_applications(double solves) const {
    return solves / (1 + 2 * column_cost_ * static_cast<double>(stiffness_.owners()));
  }

  void make_system(std::size_t p) {
    const PhaseContact& phase = contacts_.phases()[p];
    PhaseSystem& system = systems_[p];
    if (phase.y.empty()) return;
    const Eigen::MatrixXd moved = compliance_.among(phase.touched) * phase.u_by_y;
    system.wear = phase.worn_by_y - phase.worn_by_u * moved;
    Eigen::MatrixXd A = phase.y_by_y - phase.y_by_u * moved;
    // Nothing carries the force: the outer iteration will fail.
    for (Eigen::Index w = std::ssize(phase.closed); w < A.cols(); ++w)
      if (A.col(w).isZero(0)) A(w, w) = 1;
    system.A.compute(A);
    system.fed_back = system.wear * system.A.solve(phase.y_by_worn);
  }

  /// Open nodes have a row of their own.
  void solve_open(std::span<double> s, std::span<double> z) const {
    for (const PhaseContact& phase : contacts_.phases()) {
      auto closed = phase.closed.begin();
      for (std::size_t c = 0; c < phase.nodes.size(); ++c) {
        if (closed != phase.closed.end() && closed->node == static_cast<int>(c)) {
          ++closed;
          continue;
        }
        const int l = phase.nodes[c].multiplier;
        const double own = J_[structure_.pattern.find(l, l)];
        z[l] = own == 0 ? s[l] : s[l] / own;
      }
    }
    contact_columns_.subtract(z, s);
  }

  /// f of every phase, and q.
  void make_right_sides(std::span<const double> s, std::span<const double> x0) {
    right_of_wear_.setZero();
    for (std::size_t p = 0; p < systems_.size(); ++p) {
      const PhaseContact& phase = contacts_.phases()[p];
      const Eigen::VectorXd x = phase.displacements(x0);
      Eigen::VectorXd& f = systems_[p].right = -(phase.y_by_u * x);
      for (std::size_t k = 0; k < phase.y.size(); ++k) f[k] += s[phase.y[k]];
      for (std::size_t k = 0; k < phase.closed.size(); ++k)
        for (const ContactEntries::OnSurface& on : phase.closed[k].on)
          f[k] -= contacts_.entries().shape_part(on, s);
      right_of_wear_(phase.worn) += phase.worn_by_u * x;
    }
  }

  /// The multipliers of closed nodes and the rigid motions, into contact_.
  void solve_contact() {
    for (std::size_t p = 0; p < systems_.size(); ++p)
      if (const PhaseSystem& system = systems_[p]; system.right.size() > 0)
        right_of_wear_(contacts_.phases()[p].worn) += system.wear * system.A.solve(system.right);
    if (right_of_wear_.size() > 0) right_of_wear_ = wear_.solve(right_of_wear_).eval();
    std::fill(contact_.begin(), contact_.end(), 0.0);
    for (std::size_t p = 0; p < systems_.size(); ++p) {
      PhaseSystem& system = systems_[p];
      const PhaseContact& phase = contacts_.phases()[p];
      if (system.right.size() == 0) continue;
      system.right += phase.y_by_worn * right_of_wear_(phase.worn);
      const Eigen::VectorXd y = system.A.solve(system.right);
      for (std::size_t k = 0; k < phase.y.size(); ++k) contact_[phase.y[k]] = y[k];
    }
  }

  const Structure& structure_;
  std::span<const double> J_;
  const double column_cost_;  // in solves with K
  StiffnessBlock stiffness_;
  PhaseContacts contacts_;
  ContactCompliance compliance_;
  std::vector<PhaseSystem> systems_;           // by phase
  const bool may_float_;                       // contact may be what holds a body
  Eigen::PartialPivLU<Eigen::MatrixXd> wear_;  // of zeta
  Eigen::VectorXd right_of_wear_;              // then zeta
  JacobianBlock contact_columns_, wear_by_displacement_;
  FactoredBlock wear_block_;
  std::vector<double> contact_;  // y of all phases, of the system's size
};

}  // namespace

std::unique_ptr<CoreSolver> make_compliance_core(const Structure& structure,
                                                 const InnerSolverMaker& inner) {
  return std::make_unique<ComplianceCore>(structure, inner);
}

}  // namespace gnomon
