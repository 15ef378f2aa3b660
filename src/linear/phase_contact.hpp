// The entries of a coupled Jacobian that belong to the closed contact nodes of several contact
// states at one shape.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "linear/contact_entries.hpp"

namespace gnomon {

/// A contact node that is closed in a state.
struct ClosedNode {
  int node = 0;                                    ///< contact node
  std::vector<ContactEntries::Share> shares = {};  ///< J_ul and J_lu at the nodes that it moves
  std::vector<ContactEntries::OnSurface> on = {};  ///< a and J_cl of surface nodes
};

/// A contact state. Indices of J are rows and columns: u the displacements of the nodes that closed
/// contact nodes move, three each; y the multipliers l of these, then the rigid motions w; c the
/// shape unknowns of surface nodes. What pressures wear has one direction m at a surface node, in
/// all phases.
struct PhaseContact {
  std::vector<ContactEntries::Node> nodes;
  std::vector<int> rigid;       ///< numbers of w
  std::vector<NodeUnknowns> u;  ///< displacements of all points
  // Of the current J:
  std::vector<ClosedNode> closed;
  std::vector<int> touched;                    ///< points that closed nodes move
  std::vector<int> y;                          ///< numbers of y
  std::vector<int> worn;                       ///< surface nodes, numbered among all that wear
  Eigen::SparseMatrix<double> u_by_y, y_by_u;  ///< J_uy, J_yu; of each node its own alone
  Eigen::MatrixXd y_by_y;                      ///< J_yy
  Eigen::MatrixXd y_by_worn;                   ///< a.m
  Eigen::MatrixXd worn_by_y;                   ///< m.J_cy
  Eigen::SparseMatrix<double> worn_by_u;       ///< m.J_cu

  /// Displacements of the points that closed nodes move.
  Eigen::VectorXd displacements(std::span<const double> x) const {
    Eigen::VectorXd result(most_components * std::ssize(touched));
    for (std::size_t k = 0; k < touched.size(); ++k)
      result.segment<most_components>(most_components * static_cast<Eigen::Index>(k)) =
          values_at(u[touched[k]], x);
    return result;
  }
};

/// The points are the nodes that contact nodes may move: their own, and those of other bodies.
class PhaseContacts {
public:
  /// `structure` must outlive the object.
  PhaseContacts(const Structure& structure, std::size_t phases)
      : entries_(structure), phases_(phases) {
    for (int i : unknowns_of(structure, {Role::rigid}))
      phases_[structure.block_of(i).owner].rigid.push_back(i);
    for (const ContactEntries::Node& node : entries_.nodes()) {
      add_point(node.state, node.group, node.u);
      for (const ContactEntries::Partner& partner : node.partners)
        add_point(node.state, partner.group, partner.u);
      phases_[node.state].nodes.push_back(node);
    }
  }

  void update(std::span<const double> J) {
    entries_.update(J);
    std::vector<NodeValues> direction(entries_.surfaces().size(), NodeValues::Zero());
    for (PhaseContact& phase : phases_) find_closed(phase, direction);
    std::vector<int> worn(direction.size(), -1);
    worn_ = 0;
    for (std::size_t s = 0; s < direction.size(); ++s)
      if (NodeValues& m = direction[s]; !m.isZero(0)) m.stableNormalize(), worn[s] = worn_++;
    touched_.clear();
    for (PhaseContact& phase : phases_) {
      PhaseEntries(*this, phase, direction, worn).fill();
      touched_.insert(touched_.end(), phase.touched.begin(), phase.touched.end());
    }
    std::ranges::sort(touched_);
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  }

  const std::vector<PhaseContact>& phases() const { return phases_; }
  /// Points that closed nodes move in a phase, ascending.
  const std::vector<int>& touched() const { return touched_; }
  /// Number of surface nodes that wear.
  int worn() const { return worn_; }
  /// Whether bodies meet each other, not a rigid partner.
  bool have_partners() const {
    return std::ranges::any_of(entries_.nodes(),
                               [](const auto& node) { return !node.partners.empty(); });
  }
  const ContactEntries& entries() const { return entries_; }

private:
  void add_point(int phase, int group, const NodeUnknowns& u) {
    const auto [at, is_new] = points_.try_emplace(group, static_cast<int>(points_.size()));
    if (is_new)
      for (PhaseContact& other : phases_) other.u.push_back({-1, -1, -1});
    phases_[phase].u[at->second] = u;
  }

  void find_closed(PhaseContact& phase, std::vector<NodeValues>& direction) const {
    phase.closed.clear();
    for (std::size_t c = 0; c < phase.nodes.size(); ++c) {
      ClosedNode node{static_cast<int>(c), entries_.shares(phase.nodes[c])};
      if (node.shares.front().B.isZero(0) || node.shares.front().C.isZero(0)) continue;  // open
      node.on = entries_.on_surfaces(phase.nodes[c]);
      for (const ContactEntries::OnSurface& on : node.on) direction[on.surface] += on.e;
      phase.closed.push_back(std::move(node));
    }
  }

  /// The entries of J that a phase has.
  class PhaseEntries {
  public:
    PhaseEntries(const PhaseContacts& contacts, PhaseContact& phase,
                 const std::vector<NodeValues>& direction, const std::vector<int>& worn)
        : entries_(contacts.entries_),
          points_(contacts.points_),
          phase_(phase),
          direction_(direction),
          worn_(worn),
          point_(phase.u.size(), -1),
          row_(worn.size(), -1) {}

    void fill() {
      number();
      const auto y = std::ssize(phase_.y), worn = std::ssize(phase_.worn),
                 u = most_components * std::ssize(phase_.touched);
      phase_.y_by_y.setZero(y, y);
      phase_.y_by_worn.setZero(y, worn);
      phase_.worn_by_y.setZero(worn, y);
      for (int k = 0; k < y; ++k)
        for (int j = 0; j < y; ++j)
          if (k == j || k >= closed() || j >= closed())
            phase_.y_by_y(k, j) = entries_.at(phase_.y[k], phase_.y[j]);
      for (int k = 0; k < closed(); ++k) add_closed(k);
      make(phase_.u_by_y, u, y, u_by_y_);
      make(phase_.y_by_u, y, u, y_by_u_);
      make(phase_.worn_by_u, worn, u, worn_by_u_);
    }

  private:
    using Entries = std::vector<Eigen::Triplet<double>>;
    int closed() const { return static_cast<int>(phase_.closed.size()); }

    /// What of points, surface nodes and unknowns the phase has.
    void number() {
      phase_.touched.clear();
      phase_.worn.clear();
      phase_.y.clear();
      for (const ClosedNode& node : phase_.closed) {
        phase_.y.push_back(phase_.nodes[node.node].multiplier);
        for (const ContactEntries::Share& share : node.shares)
          if (int& at = point_[points_.at(share.group)]; at < 0) {
            at = static_cast<int>(phase_.touched.size());
            phase_.touched.push_back(points_.at(share.group));
          }
        for (const ContactEntries::OnSurface& on : node.on)
          if (int& at = row_[on.surface]; at < 0 && worn_[on.surface] >= 0) {
            at = static_cast<int>(phase_.worn.size());
            phase_.worn.push_back(worn_[on.surface]);
          }
      }
      phase_.y.insert(phase_.y.end(), phase_.rigid.begin(), phase_.rigid.end());
    }

    void add_closed(int k) {
      const ClosedNode& node = phase_.closed[k];
      for (const ContactEntries::Share& share : node.shares) add_share(k, share);
      for (const ContactEntries::OnSurface& on : node.on) {
        const int row = row_[on.surface];
        if (row < 0) continue;
        phase_.y_by_worn(k, row) = on.a.dot(direction_[on.surface]);
        phase_.worn_by_y(row, k) = on.e.dot(direction_[on.surface]);
        for (std::size_t j = phase_.closed.size(); j < phase_.y.size(); ++j)
          phase_.worn_by_y(row, static_cast<int>(j)) = wear(on.surface, phase_.y[j]);
      }
    }
    void add_share(int k, const ContactEntries::Share& share) {
      for (int i = 0; i < most_components; ++i) {
        const int column = most_components * point_[points_.at(share.group)] + i;
        u_by_y_.emplace_back(column, k, share.B[i]);
        y_by_u_.emplace_back(k, column, share.C[i]);
        for (std::size_t j = phase_.closed.size(); j < phase_.y.size(); ++j) {
          const int w = phase_.y[j];
          u_by_y_.emplace_back(column, static_cast<int>(j), entries_.at(share.u[i], w));
          y_by_u_.emplace_back(static_cast<int>(j), column, entries_.at(w, share.u[i]));
        }
        for (const ContactEntries::OnSurface& on : phase_.closed[k].on)
          if (const int row = row_[on.surface]; row >= 0)
            worn_by_u_.emplace_back(row, column, wear(on.surface, share.u[i]));
      }
    }
    /// m.J_c of a column.
    double wear(int surface, int column) const {
      double sum = 0;
      for (int c = 0; c < most_components; ++c)
        sum += direction_[surface][c] * entries_.at(entries_.surfaces()[surface][c], column);
      return sum;
    }
    /// Contact nodes may share points and surface nodes: what several of them have is the same.
    static void make(Eigen::SparseMatrix<double>& matrix, long rows, long columns,
                     const Entries& entries) {
      matrix.resize(rows, columns);
      matrix.setFromTriplets(entries.begin(), entries.end(), [](double, double b) { return b; });
    }

    const ContactEntries& entries_;
    const std::map<int, int>& points_;
    PhaseContact& phase_;
    const std::vector<NodeValues>& direction_;  // m, by surface node
    const std::vector<int>& worn_;              // number among all that wear, by surface node
    std::vector<int> point_, row_;  // in `touched`, by point; in `worn`, by surface node
    Entries u_by_y_, y_by_u_, worn_by_u_;
  };

  ContactEntries entries_;
  std::map<int, int> points_;  // by Structure::group
  std::vector<PhaseContact> phases_;
  std::vector<int> touched_;
  int worn_ = 0;
};

}  // namespace gnomon
