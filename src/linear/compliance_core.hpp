// Several contact states of one body at one shape: phases of a cycle.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <gnomon/linear/jacobian_block.hpp>
#include <memory>
#include <span>
#include <vector>

#include "linear/contact_compliance.hpp"
#include "linear/core_solver.hpp"
#include "linear/factored_block.hpp"
#include "linear/phase_contact.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// Solves J z = r in the unknowns u_p (displacements), l_p (contact multipliers of closed nodes)
/// and w_p (rigid motions) of the phases p, and c (shape of the worn surface), which alone couples
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
/// to which K contributes only its compliance at the closed nodes (ContactCompliance):
///
///   A_p y_p - (a.m) zeta = f_p,   f_l = r_l - a r_c - J_lu x_p,   f_w = r_w - J_wu x_p
///   A_p = J_yy - J_yu K^-1 J_uy
///   zeta = sum_p V_p y_p + q,     V_p = m.J_cy - m.J_cu K^-1 J_uy,   q = sum_p m.J_cu x_p
///
/// and one for what is worn: (1 - sum_p V_p A_p^-1 (a.m)) zeta = sum_p V_p A_p^-1 f_p + q. Two
/// solves with K, all phases as columns, thus make an application, whatever nodes touch.
class ComplianceCore : public CoreSolver {
public:
  /// `structure` must outlive the object; throws as StiffnessBlock.
  ComplianceCore(const Structure& structure, const InnerSolverMaker& inner);

  void refresh(std::span<const double> J) override;
  double update_cost() const override;
  void update() override;
  int set_up(bool whole) override;
  double set_up_cost() const override;
  void solve(std::span<double> s, std::span<double> z) override;

private:
  struct PhaseSystem {
    Eigen::PartialPivLU<Eigen::MatrixXd> A;
    Eigen::MatrixXd wear;      ///< V, a row per closed node
    Eigen::MatrixXd fed_back;  ///< V A^-1 (a.m)
    Eigen::VectorXd right;     ///< f
  };
  double in_applications(double solves) const;
  Eigen::MatrixXd response(const PhaseContact& phase) const;
  void make_system(std::size_t p);
  void couple(const PhaseContact& phase, const PhaseSystem& system, Eigen::MatrixXd& wear) const;
  int of_surface(const ClosedNode& node) const;
  void solve_open(std::span<double> s, std::span<double> z) const;
  void make_right_sides(std::span<const double> s, std::span<const double> x0);
  void solve_contact();

  const Structure& structure_;
  std::span<const double> J_;
  const double column_cost_;  // in solves with K
  StiffnessBlock stiffness_;
  PhaseContacts contacts_;
  ContactCompliance compliance_;
  std::vector<PhaseSystem> systems_;           // by phase
  std::vector<int> number_;                    // of a surface node in zeta, -1: nothing wears
  Eigen::PartialPivLU<Eigen::MatrixXd> wear_;  // of zeta
  Eigen::VectorXd right_of_wear_;              // then zeta
  JacobianBlock contact_columns_, wear_by_displacement_;
  FactoredBlock wear_block_;
  std::vector<double> contact_;  // y of all phases, of the system's size
};

}  // namespace gnomon
