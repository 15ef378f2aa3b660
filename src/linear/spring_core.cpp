#include <Eigen/LU>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>

#include "linear/contact_elimination.hpp"
#include "linear/core_solver.hpp"
#include "linear/low_rank_update.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

namespace {

constexpr Roles core_roles = {Role::stiffness, Role::multiplier, Role::evolution};

/// The stiffness with springs is solved, and the rigid motions, any number, are bordered.
class SpringCore : public CoreSolver {
public:
  SpringCore(const Structure& s, const InnerSolverMaker& inner)
      : column_cost_(inner.column_cost),
        contact_(s, follows_springs()),
        stiffness_(s, Role::stiffness, inner, contact_.joined()),
        rigid_row_(s, {Role::rigid}, core_roles),
        rigid_block_(s, {Role::rigid}, {Role::rigid}),
        rigid_column_(s, core_roles, {Role::rigid}),
        core_(unknowns_of(s, core_roles)),
        rigid_(unknowns_of(s, {Role::rigid})),
        border_(rigid_.size(), std::vector<double>(s.size)) {}

  void refresh(std::span<const double> J) override {
    J_ = J;
    contact_.update(J);
    for (JacobianBlock* block : {&rigid_row_, &rigid_block_, &rigid_column_}) block->refresh(J);
    terms_ = contact_.low_rank_terms(stiffness_.part());
    bordered_ = false;
  }
  double update_cost() const override {
    return column_cost_ * static_cast<double>(change_.columns_to_solve(terms_));
  }
  void update() override {
    if (!stiffness_.empty()) change_.set(terms_, stiffness_.solver(), stiffness_.size());
  }
  int set_up(bool whole) override {
    contact_.add_springs(stiffness_.part(), stiffness_.gather(J_));
    terms_ = contact_.low_rank_terms(stiffness_.part());  // common wear alone
    // With multigrid the columns cost more than the set-up: they are kept until fresh ones are
    // needed.
    if (follows_springs() || whole) change_.clear();
    const int factorizations = stiffness_.set_up("the stiffness of the body");
    update();
    bordered_ = false;
    return factorizations;
  }
  double set_up_cost() const override {
    return stiffness_.empty() ? 0 : stiffness_.solver().set_up_cost();
  }
  void solve(std::span<double> s, std::span<double> z) override {
    if (!rigid_.empty() && !bordered_) make_border();
    solve_free(s, z);
    if (!rigid_.empty()) solve_rigid(s, z);
  }

private:
  bool follows_springs() const { return column_cost_ < 1; }
  /// Solves the rows of u, lambda and c; s is changed.
  void solve_free(std::span<double> s, std::span<double> z) {
    contact_.condense(s);
    const std::span<double> x = stiffness_.solve(s);
    change_.correct(x);
    stiffness_.scatter(x, z);
    contact_.recover(s, z);
  }

  /// Solves for a unit of each w: then z = -border, and `schur_` is the Schur complement of J_ww.
  void make_border() {
    const auto count = static_cast<Eigen::Index>(rigid_.size());
    Eigen::MatrixXd complement = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      std::vector<double>& column = border_[static_cast<std::size_t>(k)];
      const int w = rigid_[static_cast<std::size_t>(k)];
      std::fill(column.begin(), column.end(), 0.0);
      std::vector<double> unit(column.size()), right(column.size());
      unit[w] = -1;
      rigid_column_.subtract(unit, right);
      solve_free(right, column);
      std::fill(right.begin(), right.end(), 0.0);
      rigid_row_.subtract(column, right);
      rigid_block_.subtract(unit, right);
      for (Eigen::Index l = 0; l < count; ++l)
        complement(l, k) = right[rigid_[static_cast<std::size_t>(l)]];
      // Nothing carries the force: the outer iteration will fail.
      if (complement.col(k).isZero(0)) complement(k, k) = 1;
    }
    schur_.compute(complement);
    bordered_ = true;
  }

  void solve_rigid(std::span<double> s, std::span<double> z) const {
    rigid_row_.subtract(z, s);
    Eigen::VectorXd right(static_cast<Eigen::Index>(rigid_.size()));
    for (std::size_t k = 0; k < rigid_.size(); ++k)
      right[static_cast<Eigen::Index>(k)] = s[rigid_[k]];
    const Eigen::VectorXd w = schur_.solve(right);
    for (std::size_t k = 0; k < rigid_.size(); ++k) {
      const double value = z[rigid_[k]] = w[static_cast<Eigen::Index>(k)];
      for (int i : core_) z[i] -= border_[k][i] * value;
    }
  }

  std::span<const double> J_;
  const double column_cost_;
  ContactElimination contact_;
  StiffnessBlock stiffness_;
  LowRankUpdate change_;            // of the stiffness
  std::vector<RankOneTerm> terms_;  // of which the change has to consist
  JacobianBlock rigid_row_, rigid_block_, rigid_column_;
  std::vector<int> core_;
  std::vector<int> rigid_;                      // w
  bool bordered_ = false;                       // the two below belong to J and the set-up
  std::vector<std::vector<double>> border_;     // solutions for the columns of w
  Eigen::PartialPivLU<Eigen::MatrixXd> schur_;  // of J_ww, the Schur complement
};

}  // namespace

std::unique_ptr<CoreSolver> make_spring_core(const Structure& structure,
                                             const InnerSolverMaker& inner) {
  return std::make_unique<SpringCore>(structure, inner);
}

}  // namespace gnomon
