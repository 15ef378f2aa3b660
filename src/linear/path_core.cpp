// Contact states along a path, where friction may stick: phases of a cycle that depend on the ones
// before them.

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "linear/contact_compliance.hpp"
#include "linear/core_solver.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

namespace {

/// Solves J z = r in the unknowns u_p (displacements), y_p (multipliers of closed nodes, normal and
/// tangential, of pairs their places on the partner, and rigid motions) of the phases p, and g
/// (shape of the worn surface, and memory). Indices of J are rows and columns; J_ug is neglected. K
/// is the mean stiffness of the phases, and the only matrix that is factorized: multipliers press
/// nodes, but make no springs (StickTerm).
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
      : structure_(structure),
        column_cost_(inner.column_cost),
        stiffness_(structure, Role::stiffness, inner),
        phases_(stiffness_.owners()),
        place_(structure.size),
        compliance_(find_points()),
        contact_columns_(structure, {Role::stiffness, Role::rigid},
                         {Role::multiplier, Role::friction, Role::rigid}),
        slow_rows_(structure, {Role::evolution, Role::memory},
                   {Role::stiffness, Role::multiplier, Role::friction, Role::rigid}),
        contact_(structure.size) {}

  void refresh(std::span<const double> J) override {
    J_ = J;
    find_closed();
  }
  double update_cost() const override {
    return in_applications(column_cost_ * static_cast<double>(compliance_.missing(touched_)));
  }
  void update() override {
    compliance_.solve(touched_, stiffness_);
    gather();
    eliminate();
  }
  int set_up(bool) override {
    stiffness_.gather(J_);
    if (may_float_) stiffness_.add_soft_springs(soft);
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
    for (const Phase& phase : phases_)
      for (std::size_t k = 0; k < phase.y.size(); ++k)
        contact_[phase.y[k]] = phase.solution[static_cast<Eigen::Index>(k)];
    contact_columns_.subtract(J_, contact_, s);
    stiffness_.scatter(stiffness_.solve(s), z);
    for (const Phase& phase : phases_)
      for (const int i : phase.y) z[i] = contact_[i];
    slow_rows_.subtract(J_, z, s);
    for (const int i : slow_) z[i] = s[i] / at(i, i);
    for (std::size_t k = 0; k < g_.size(); ++k) z[g_[k]] = slow_solution_[long(k)];
  }

private:
  static constexpr double soft = 1e-7;
  using Sparse = Eigen::SparseMatrix<double>;
  using Entries = std::vector<Eigen::Triplet<double>>;
  /// What an unknown is.
  struct Place {
    enum class Kind : char { other, u, y, g } kind = Kind::other;
    int phase = 0;
    int point = -1, component = 0;  ///< of u and y: its contact node; -1: rigid
    int number = -1;                ///< u: among touched, y: in its phase, g: in g_; -1: not active
  };
  struct Phase {
    std::vector<int> u;         ///< displacements of all points
    std::vector<int> all_y, y;  ///< all, and those that are solved together
    std::vector<char> closed;   ///< by point
    // Of the current J, v the displacements of touched points:
    Sparse v_by_y, y_by_v, y_by_before, g_by_v;  ///< columns or rows of v
    Eigen::MatrixXd y_by_y, y_by_y_before, g_by_y, y_by_g;
    Eigen::MatrixXd moved;  ///< v by y, with the sign of a force
    Eigen::PartialPivLU<Eigen::MatrixXd> A;
    Eigen::MatrixXd F, H, Z;  ///< Z: y by g
    Eigen::VectorXd solution;
  };

  double at(int row, int column) const {
    const int position = structure_.pattern.find(row, column);
    return position < 0 ? 0 : J_[position];
  }
  double in_applications(double solves) const {
    return solves / (1 + 2 * column_cost_ * static_cast<double>(stiffness_.owners()));
  }

  /// Nodes that a multiplier presses are the points. Returns the numbers of their displacements in
  /// the block of the stiffness.
  std::vector<NodeUnknowns> find_points() {
    using Kind = Place::Kind;
    std::map<int, int> point_of;
    const auto role = [this](int i) { return structure_.block_of(i).role; };
    const SparsePattern& pattern = structure_.pattern;
    std::set<int> carry;
    for (int i = 0; i < structure_.size; ++i) {
      if (role(i) != Role::multiplier) continue;
      carry.insert(structure_.group[i]);
      point_of.try_emplace(structure_.group[i], static_cast<int>(point_of.size()));
      for (int k = pattern.column_start[i]; k < pattern.column_start[i + 1]; ++k)
        if (const int row = pattern.row_index[k]; role(row) == Role::stiffness)
          point_of.try_emplace(structure_.group[row], static_cast<int>(point_of.size()));
    }
    may_float_ = point_of.size() > carry.size();
    std::vector<NodeUnknowns> numbers(point_of.size(), {-1, -1, -1});
    for (int i = 0; i < structure_.size; ++i) {
      Place& place = place_[i];
      place.phase = structure_.block_of(i).owner;
      place.component = static_cast<unsigned char>(structure_.component[i]);
      if (const auto found = point_of.find(structure_.group[i]); found != point_of.end())
        place.point = found->second;
      if (role(i) == Role::multiplier || role(i) == Role::friction || role(i) == Role::rigid) {
        place.kind = Kind::y;
        phases_[place.phase].all_y.push_back(i);
      } else if (role(i) == Role::evolution || role(i) == Role::memory) {
        place.kind = Kind::g;
        place.phase = 0;
        slow_.push_back(i);
      } else if (role(i) == Role::stiffness && place.point >= 0) {
        place.kind = Kind::u;
        phases_[place.phase].u.push_back(i);
        const std::vector<int>& block = stiffness_.unknowns(place.phase);
        numbers[place.point][place.component] =
            static_cast<int>(std::ranges::lower_bound(block, i) - block.begin());
      }
    }
    return numbers;
  }

  /// A closed node has rows that depend on displacements.
  void find_closed() {
    const SparsePattern& pattern = structure_.pattern;
    std::vector<char> touched(points(), 0);
    for (Phase& phase : phases_) phase.closed.assign(points(), 0);
    for (int j = 0; j < structure_.size; ++j) {
      if (place_[j].kind != Place::Kind::u) continue;
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        if (const Place& row = place_[pattern.row_index[k]];
            row.kind == Place::Kind::y && row.point >= 0 && J_[k] != 0)
          phases_[row.phase].closed[row.point] = touched[row.point] = touched[place_[j].point] = 1;
    }
    touched_.clear();
    for (std::size_t point = 0; point < touched.size(); ++point)
      if (touched[point]) touched_.push_back(static_cast<int>(point));
    number(touched);
  }

  void number(const std::vector<char>& touched) {
    std::vector<int> position(touched.size(), -1);
    for (std::size_t k = 0; k < touched_.size(); ++k) position[touched_[k]] = static_cast<int>(k);
    for (Phase& phase : phases_) phase.y.clear();
    g_.clear();
    for (int i = 0; i < structure_.size; ++i) {
      Place& place = place_[i];
      place.number = -1;
      if (place.kind == Place::Kind::u && position[place.point] >= 0)
        place.number = most_components * position[place.point] + place.component;
      if (place.kind == Place::Kind::y &&
          (place.point < 0 || phases_[place.phase].closed[place.point])) {
        place.number = static_cast<int>(phases_[place.phase].y.size());
        phases_[place.phase].y.push_back(i);
      }
      if (place.kind == Place::Kind::g && place.point >= 0 && touched[place.point]) {
        place.number = static_cast<int>(g_.size());
        g_.push_back(i);
      }
    }
  }

  /// The blocks of J.
  void gather() {
    using Kind = Place::Kind;
    struct Lists {
      Entries v_by_y, y_by_v, y_by_before, g_by_v;
    };
    std::vector<Lists> lists(phases_.size());
    const auto g = static_cast<Eigen::Index>(g_.size());
    for (Phase& phase : phases_) {
      const auto y = std::ssize(phase.y);
      const auto p = static_cast<std::size_t>(&phase - phases_.data());
      phase.y_by_y.setZero(y, y);
      phase.y_by_y_before.setZero(y, p == 0 ? 0 : std::ssize(phases_[p - 1].y));
      phase.g_by_y.setZero(g, y);
      phase.y_by_g.setZero(y, g);
    }
    g_by_g_.setZero(g, g);
    const SparsePattern& pattern = structure_.pattern;
    for (int j = 0; j < structure_.size; ++j) {
      const Place& column = place_[j];
      if (column.number < 0) continue;
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const Place& row = place_[pattern.row_index[k]];
        const double value = J_[k];
        if (row.number < 0 || value == 0) continue;
        const bool same = row.phase == column.phase;
        Lists& of_column = lists[column.phase];
        if (row.kind == Kind::u && column.kind == Kind::y && same)
          of_column.v_by_y.emplace_back(row.number, column.number, value);
        else if (row.kind == Kind::y && column.kind == Kind::u)
          (same ? of_column.y_by_v : lists[row.phase].y_by_before)
              .emplace_back(row.number, column.number, value);
        else if (row.kind == Kind::y && column.kind == Kind::y)
          (same ? phases_[row.phase].y_by_y : phases_[row.phase].y_by_y_before)(
              row.number, column.number) = value;
        else if (row.kind == Kind::y && column.kind == Kind::g)
          phases_[row.phase].y_by_g(row.number, column.number) = value;
        else if (row.kind == Kind::g && column.kind == Kind::u)
          of_column.g_by_v.emplace_back(row.number, column.number, value);
        else if (row.kind == Kind::g && column.kind == Kind::y)
          phases_[column.phase].g_by_y(row.number, column.number) = value;
        else if (row.kind == Kind::g && column.kind == Kind::g)
          g_by_g_(row.number, column.number) = value;
      }
    }
    const auto make = [](Sparse& matrix, long rows, long columns, const Entries& entries) {
      matrix.resize(rows, columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
    };
    const long v = most_components * std::ssize(touched_);
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      Phase& phase = phases_[p];
      const long y = std::ssize(phase.y);
      make(phase.v_by_y, v, y, lists[p].v_by_y);
      make(phase.y_by_v, y, v, lists[p].y_by_v);
      make(phase.y_by_before, y, v, lists[p].y_by_before);
      make(phase.g_by_v, g, v, lists[p].g_by_v);
    }
  }

  /// A, F, H, the y of unit g along the path, and the matrix of g.
  void eliminate() {
    const Eigen::MatrixXd G = compliance_.among(touched_);
    Eigen::MatrixXd rest = g_by_g_;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      Phase& phase = phases_[p];
      phase.moved = G * phase.v_by_y;
      Eigen::MatrixXd A = phase.y_by_y - phase.y_by_v * phase.moved;
      for (Eigen::Index k = 0; k < A.cols(); ++k)  // a rigid motion that nothing touches
        if (A.col(k).isZero(0) || A.row(k).isZero(0)) A(k, k) = 1;
      phase.A.compute(A);
      phase.H = phase.g_by_y - phase.g_by_v * phase.moved;
      Eigen::MatrixXd right = phase.y_by_g;
      if (p > 0) {
        phase.F = phase.y_by_y_before - phase.y_by_before * phases_[p - 1].moved;
        right -= phase.F * phases_[p - 1].Z;
      }
      phase.Z = phase.A.solve(right);
      rest -= phase.H * phase.Z;
    }
    if (rest.size() > 0) rest_.compute(rest);
  }

  /// Open nodes have rows of their own.
  void solve_open(std::span<double> s, std::span<double> z) const {
    for (const Phase& phase : phases_)
      for (const int i : phase.all_y)
        if (place_[i].number < 0) {
          const double own = at(i, i);
          z[i] = own == 0 ? s[i] : s[i] / own;
        }
    contact_columns_.subtract(J_, z, s);
  }

  Eigen::VectorXd displacements(const Phase& phase, std::span<const double> x) const {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(most_components * std::ssize(touched_));
    for (const int i : phase.u)
      if (place_[i].number >= 0) v[place_[i].number] = x[i];
    return v;
  }

  /// y of all phases and g, from s and the displacements x without contact.
  void solve_contact(std::span<const double> s, std::span<const double> x) {
    Eigen::VectorXd q(g_.size());
    for (std::size_t k = 0; k < g_.size(); ++k) q[long(k)] = s[g_[k]];
    Eigen::VectorXd before;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      Phase& phase = phases_[p];
      const Eigen::VectorXd v = displacements(phase, x);
      Eigen::VectorXd f(phase.y.size());
      for (std::size_t k = 0; k < phase.y.size(); ++k) f[long(k)] = s[phase.y[k]];
      f -= phase.y_by_v * v;
      if (p > 0) f -= phase.y_by_before * before + phase.F * phases_[p - 1].solution;
      phase.solution = phase.A.solve(f);
      q -= phase.g_by_v * v + phase.H * phase.solution;
      before = v;
    }
    slow_solution_ = q;
    if (q.size() > 0) slow_solution_ = rest_.solve(q);
    for (Phase& phase : phases_) phase.solution -= phase.Z * slow_solution_;
  }

  std::size_t points() const { return compliance_.points(); }

  const Structure& structure_;
  std::span<const double> J_;
  const double column_cost_;  // in solves with K
  StiffnessBlock stiffness_;
  bool may_float_ = false;  // a body that multipliers press may have no other support
  std::vector<Phase> phases_;
  std::vector<Place> place_;  // by unknown
  std::vector<int> slow_;     // all unknowns g
  ContactCompliance compliance_;
  std::vector<int> touched_;  // points that are closed in any phase
  std::vector<int> g_;        // those of slow_ at touched points
  Eigen::MatrixXd g_by_g_;
  Eigen::PartialPivLU<Eigen::MatrixXd> rest_;  // of g, without y
  Eigen::VectorXd slow_solution_;
  JacobianBlock contact_columns_, slow_rows_;
  std::vector<double> contact_;  // y of all phases, of the system's size
};

}  // namespace

std::unique_ptr<CoreSolver> make_path_core(const Structure& structure,
                                           const InnerSolverMaker& inner) {
  return std::make_unique<PathCore>(structure, inner);
}

}  // namespace gnomon
