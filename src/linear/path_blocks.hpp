// The blocks of a Jacobian along a path of contact states, between the unknowns that are solved for
// together (path_core.cpp).
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// Points are the nodes that multipliers press. v are the displacements of touched points, y the
/// unknowns of closed nodes and rigid motions, g the shape and the memory of touched points.
/// Unknowns e follow from these,
///
///   e = e_0 - E_v v - E_g g
///
/// as the place of a node on the partner that covers it. They are put into the other rows, so that
/// blocks are as large as contact, and not as what the partner covers.
class PathBlocks {
public:
  using Sparse = Eigen::SparseMatrix<double>;
  struct Phase {
    std::vector<int> u;      ///< displacements of all points
    std::vector<int> all_y;  ///< multipliers, places on the partner and rigid motions of all
    std::vector<int> y, e;   ///< of these
    Sparse v_by_y, y_by_v, y_by_before, g_by_v;  ///< before: v of the phase before
    Eigen::MatrixXd y_by_y, y_by_y_before, g_by_y, y_by_g;
    Sparse y_by_e, y_by_e_before, g_by_e;  ///< that are in the others
  };

  /// `structure` must outlive the object.
  PathBlocks(const Structure& structure, const StiffnessBlock& stiffness)
      : structure_(structure),
        phases_(stiffness.owners()),
        pressed_(structure, {Role::stiffness}, {Role::multiplier, Role::friction, Role::rigid}),
        rows_(structure,
              {Role::multiplier, Role::friction, Role::rigid, Role::evolution, Role::memory},
              {Role::stiffness, Role::multiplier, Role::friction, Role::rigid, Role::evolution,
               Role::memory}),
        place_(structure.size) {
    for (int i = 0; i < structure.size; ++i) own_.push_back(structure.pattern.find(i, i));
    find_points();
    find_roles(stiffness);
  }

  /// Takes the values of J, which must outlive their use, and finds what touches.
  void refresh(std::span<const double> J) {
    J_ = J;
    pressed_.refresh(J);
    rows_.refresh(J);
    find_following();
    find_touched();
    number();
  }
  /// Makes the blocks of J.
  void gather() {
    const std::vector<Entries> entries = sorted_entries();
    std::vector<Sparse> E_v, E_g;
    for (std::size_t p = 0; p < phases_.size(); ++p) {
      const auto block = [&](Kind row, Kind column, bool before = false) {
        Sparse matrix(size_of(row, p), before && p == 0 ? 0 : size_of(column, p - before));
        const Entries& of = entries[block_of(p, row, column, before)];
        matrix.setFromTriplets(of.begin(), of.end());
        return matrix;
      };
      Phase& phase = phases_[p];
      phase.v_by_y = block(Kind::u, Kind::y);
      phase.y_by_v = block(Kind::y, Kind::u);
      phase.y_by_before = block(Kind::y, Kind::u, true);
      phase.y_by_y = block(Kind::y, Kind::y);
      phase.y_by_y_before = block(Kind::y, Kind::y, true);
      phase.y_by_e = block(Kind::y, Kind::e);
      phase.y_by_e_before = block(Kind::y, Kind::e, true);
      phase.y_by_g = block(Kind::y, Kind::g);
      phase.g_by_v = block(Kind::g, Kind::u);
      phase.g_by_y = block(Kind::g, Kind::y);
      phase.g_by_e = block(Kind::g, Kind::e);
      if (p == 0) g_by_g_ = block(Kind::g, Kind::g);
      Eigen::VectorXd own(std::ssize(phase.e));
      for (Eigen::Index k = 0; k < own.size(); ++k) own[k] = this->own(phase.e[std::size_t(k)]);
      E_v.push_back(own.cwiseInverse().asDiagonal() * block(Kind::e, Kind::u));
      E_g.push_back(own.cwiseInverse().asDiagonal() * block(Kind::e, Kind::g));
    }
    for (std::size_t p = 0; p < phases_.size(); ++p) put_in_following(p, E_v, E_g);
  }

  const std::vector<Phase>& phases() const { return phases_; }
  /// The numbers of the displacements of every point in the block of the stiffness.
  const std::vector<NodeUnknowns>& points() const { return points_; }
  bool has_partners() const { return has_partners_; }
  const std::vector<int>& touched() const { return touched_; }
  const std::vector<int>& slow() const { return slow_; }  ///< unknowns g of all points
  const std::vector<int>& g() const { return g_; }
  const Eigen::MatrixXd& g_by_g() const { return g_by_g_; }
  long v_size() const { return most_components * std::ssize(touched_); }
  /// Of an unknown among v, y, e or g of its phase; -1: it is none of these.
  int number(int unknown) const { return place_[unknown].number; }
  bool follows(int unknown) const { return place_[unknown].kind == Kind::e; }
  /// On the diagonal of J, which patterns have.
  double own(int unknown) const { return J_[own_[unknown]]; }

private:
  using Entries = std::vector<Eigen::Triplet<double>>;
  enum class Kind : char { other, u, y, e, g };
  static constexpr std::size_t kinds = 5;
  /// The number of the block of a phase with these kinds of row and column; `before`: the column is
  /// of the phase before.
  static std::size_t block_of(std::size_t phase, Kind row, Kind column, bool before) {
    return 2 * (kinds * (kinds * phase + std::size_t(row)) + std::size_t(column)) + before;
  }
  /// What an unknown is.
  struct Place {
    Kind kind = Kind::other;
    int phase = 0;
    int point = -1, component = 0;  ///< -1: rigid
    int number = -1;
    bool of_contact() const { return kind == Kind::y || kind == Kind::e; }
  };

  /// Calls with row, column and value of the entries that are not zero, without the stiffness.
  template <class Call>
  void for_entries(const Call& call) const {
    for (const JacobianBlock* block : {&pressed_, &rows_})
      for (const auto& [row, column, value] : block->entries()) call(row, column, value);
  }
  bool is_solved(const Place& y) const { return y.point < 0 || closed_[y.phase][y.point]; }
  Role role(int i) const { return structure_.block_of(i).role; }

  void find_points() {
    const SparsePattern& pattern = structure_.pattern;
    std::set<int> carry;
    for (int i = 0; i < structure_.size; ++i) {
      if (role(i) != Role::multiplier) continue;
      carry.insert(structure_.group[i]);
      point_of_.try_emplace(structure_.group[i], static_cast<int>(point_of_.size()));
      for (int k = pattern.column_start[i]; k < pattern.column_start[i + 1]; ++k)
        if (const int row = pattern.row_index[k]; role(row) == Role::stiffness)
          point_of_.try_emplace(structure_.group[row], static_cast<int>(point_of_.size()));
    }
    has_partners_ = point_of_.size() > carry.size();
    points_.assign(point_of_.size(), {-1, -1, -1});
  }

  void find_roles(const StiffnessBlock& stiffness) {
    for (int i = 0; i < structure_.size; ++i) {
      Place& place = place_[i];
      place.phase = structure_.block_of(i).owner;
      place.component = static_cast<unsigned char>(structure_.component[i]);
      if (const auto found = point_of_.find(structure_.group[i]); found != point_of_.end())
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
        const std::vector<int>& block = stiffness.unknowns(place.phase);
        points_[place.point][place.component] =
            static_cast<int>(std::ranges::lower_bound(block, i) - block.begin());
      }
    }
  }

  /// They depend on no other y, and no force depends on them.
  void find_following() {
    for (const Phase& phase : phases_)
      for (const int i : phase.all_y)
        place_[i].kind = place_[i].point >= 0 && own(i) != 0 ? Kind::e : Kind::y;
    std::vector<char> not_alone(place_.size(), 0);
    for_entries([&](int row, int column, double) {
      if (!place_[column].of_contact()) return;
      if (place_[row].of_contact() && row != column) not_alone[row] = 1;
      if (role(row) == Role::stiffness || role(row) == Role::rigid) not_alone[column] = 1;
    });
    for (const Phase& phase : phases_)
      for (const int i : phase.all_y)
        if (not_alone[i]) place_[i].kind = Kind::y;
  }

  /// A closed node has rows that depend on displacements, and that are solved.
  void find_touched() {
    std::vector<char> touched(points_.size(), 0);
    closed_.assign(phases_.size(), touched);
    const auto of_point = [&](int i) { return place_[i].kind == Kind::y && place_[i].point >= 0; };
    for_entries([&](int i, int j, double) {
      if (place_[j].kind == Kind::u && of_point(i))
        closed_[place_[i].phase][place_[i].point] = touched[place_[i].point] = 1;
    });
    is_put_in_.assign(place_.size(), 0);
    for (const Phase& phase : phases_)
      for (const int i : phase.all_y)
        if (place_[i].kind == Kind::e) is_put_in_[i] = touched[place_[i].point];
    for_entries([&](int i, int j, double) {  // in rolling, of open nodes upstream
      if (place_[j].kind == Kind::e && place_[i].kind == Kind::y && is_solved(place_[i]))
        is_put_in_[j] = 1;
    });
    for_entries([&](int i, int j, double) {
      if (place_[j].kind == Kind::u && (is_put_in_[i] || of_point(i))) touched[place_[j].point] = 1;
    });
    touched_.clear();
    for (std::size_t point = 0; point < touched.size(); ++point)
      if (touched[point]) touched_.push_back(static_cast<int>(point));
  }

  void number() {
    std::vector<int> position(points_.size(), -1);
    for (std::size_t k = 0; k < touched_.size(); ++k) position[touched_[k]] = static_cast<int>(k);
    for (Phase& phase : phases_) phase.y.clear(), phase.e.clear();
    g_.clear();
    const auto append = [](std::vector<int>& to, int i) {
      to.push_back(i);
      return static_cast<int>(to.size()) - 1;
    };
    for (int i = 0; i < structure_.size; ++i) {
      Place& place = place_[i];
      Phase& phase = phases_[place.phase];
      place.number = -1;
      if (place.kind == Kind::y && is_solved(place)) place.number = append(phase.y, i);
      if (is_put_in_[i]) place.number = append(phase.e, i);
      if (place.point < 0 || position[place.point] < 0) continue;
      if (place.kind == Kind::u)
        place.number = most_components * position[place.point] + place.component;
      if (place.kind == Kind::g) place.number = append(g_, i);
    }
  }

  long size_of(Kind kind, std::size_t phase) const {
    if (kind == Kind::g) return std::ssize(g_);
    if (kind == Kind::u) return v_size();
    return std::ssize(kind == Kind::y ? phases_[phase].y : phases_[phase].e);
  }
  std::vector<Entries> sorted_entries() const {
    std::vector<Entries> entries(block_of(phases_.size(), Kind::other, Kind::other, false));
    for_entries([&](int i, int j, double value) {
      const Place &row = place_[i], &column = place_[j];
      if (row.number < 0 || column.number < 0) return;
      const bool shared = row.kind == Kind::g || column.kind == Kind::g;
      const auto phase = static_cast<std::size_t>(row.kind == Kind::g ? column.phase : row.phase);
      const bool before = !shared && row.phase != column.phase;
      entries[block_of(phase, row.kind, column.kind, before)].emplace_back(row.number,
                                                                           column.number, value);
    });
    return entries;
  }

  void put_in_following(std::size_t p, const std::vector<Sparse>& E_v,
                        const std::vector<Sparse>& E_g) {
    Phase& phase = phases_[p];
    phase.y_by_v -= Sparse(phase.y_by_e * E_v[p]);
    phase.y_by_g -= Sparse(phase.y_by_e * E_g[p]);
    phase.g_by_v -= Sparse(phase.g_by_e * E_v[p]);
    g_by_g_ -= Sparse(phase.g_by_e * E_g[p]);
    if (p == 0) return;
    phase.y_by_before -= Sparse(phase.y_by_e_before * E_v[p - 1]);
    phase.y_by_g -= Sparse(phase.y_by_e_before * E_g[p - 1]);
  }

  const Structure& structure_;
  std::span<const double> J_;
  std::vector<Phase> phases_;
  JacobianBlock pressed_, rows_;  // of forces, and of all others
  std::vector<int> own_;          // by unknown: the position of its diagonal entry in J
  std::vector<Place> place_;      // by unknown
  std::map<int, int> point_of_;   // by Structure::group
  std::vector<NodeUnknowns> points_;
  bool has_partners_ = false;
  std::vector<int> slow_;
  std::vector<std::vector<char>> closed_;  // by phase and point
  std::vector<char> is_put_in_;            // by unknown: those e that others depend on
  std::vector<int> touched_;
  std::vector<int> g_;  // those of slow_ at touched points
  Eigen::MatrixXd g_by_g_;
};

}  // namespace gnomon
