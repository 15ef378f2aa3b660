// The entries of a coupled Jacobian that belong to the closed contact nodes of several contact
// states at one shape, and the displacements of the contact nodes under unit forces at them.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <utility>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// A contact node that is closed in a state.
struct ClosedNode {
  int node = 0;                       ///< contact node
  ContactEntries::OnSurface on = {};  ///< a and J_cl of its surface node
  int worn = -1;                      ///< number of that among all that wear, -1: nothing wears
};

/// A contact state. Indices of J are rows and columns: u the displacements of the closed nodes,
/// three each; y their multipliers l, then the rigid motions w; c the shape unknowns of the surface
/// nodes that they lie upon. What the pressure wears has one direction m at a surface node, in all
/// phases.
struct PhaseContact {
  std::vector<ContactEntries::Node> nodes;
  std::vector<int> rigid;  ///< numbers of w
  // Of the current J:
  std::vector<ClosedNode> closed;
  std::vector<int> y;                          ///< numbers of y
  Eigen::SparseMatrix<double> u_by_y, y_by_u;  ///< J_uy, J_yu; of each node its own alone
  Eigen::MatrixXd y_by_y;                      ///< J_yy
  Eigen::MatrixXd worn_by_y;                   ///< m.J_cy, a row per closed node
  Eigen::SparseMatrix<double, Eigen::RowMajor> worn_by_u;  ///< m.J_cu
  Eigen::VectorXd a_m;                                     ///< a.m, by closed node

  /// Displacements of the closed nodes.
  Eigen::VectorXd displacements(std::span<const double> x) const {
    Eigen::VectorXd result(most_components * std::ssize(closed));
    for (std::size_t k = 0; k < closed.size(); ++k)
      result.segment<most_components>(most_components * static_cast<Eigen::Index>(k)) =
          values_at(nodes[closed[k].node].u, x);
    return result;
  }
};

class PhaseContacts {
public:
  /// `structure` must outlive the object.
  PhaseContacts(const Structure& structure, std::size_t phases)
      : entries_(structure), phases_(phases) {
    for (int i : unknowns_of(structure, {Role::rigid}))
      phases_[structure.block_of(i).owner].rigid.push_back(i);
    for (const ContactEntries::Node& node : entries_.nodes())
      phases_[node.state].nodes.push_back(node);
  }

  void update(std::span<const double> J) {
    entries_.update(J);
    std::vector<char> touches(phases_.front().nodes.size(), 0);
    std::vector<int> worn(entries_.surfaces().size(), -1);
    std::vector<NodeValues> direction(worn.size(), NodeValues::Zero());  // m, by surface node
    worn_ = 0;
    for (PhaseContact& phase : phases_) {
      phase.closed.clear();
      for (std::size_t c = 0; c < phase.nodes.size(); ++c) {
        if (!is_closed(phase.nodes[c])) continue;
        ClosedNode closed{.node = static_cast<int>(c), .on = entries_.on_surface(phase.nodes[c])};
        touches[c] = 1;
        if (const int surface = closed.on.surface; surface >= 0) {
          if (worn[surface] < 0) worn[surface] = worn_++;
          closed.worn = worn[surface];
          direction[surface] += closed.on.e;
        }
        phase.closed.push_back(closed);
      }
    }
    touching_.clear();
    for (std::size_t c = 0; c < touches.size(); ++c)
      if (touches[c]) touching_.push_back(static_cast<int>(c));
    for (NodeValues& m : direction)
      if (!m.isZero(0)) m.stableNormalize();
    for (PhaseContact& phase : phases_) fill(phase, direction);
  }

  const std::vector<PhaseContact>& phases() const { return phases_; }
  /// Contact nodes that are closed in a phase, ascending.
  const std::vector<int>& touching() const { return touching_; }
  /// Number of surface nodes that wear.
  int worn() const { return worn_; }
  const ContactEntries& entries() const { return entries_; }

private:
  bool is_closed(const ContactEntries::Node& node) const {
    bool force = false, gap = false;
    for (int u : node.u) {
      force |= entries_.at(u, node.multiplier) != 0;
      gap |= entries_.at(node.multiplier, u) != 0;
    }
    return force && gap;
  }

  /// The entries of J.
  void fill(PhaseContact& phase, const std::vector<NodeValues>& direction) const {
    const auto count = static_cast<int>(phase.closed.size());
    phase.y.clear();
    for (const ClosedNode& node : phase.closed)
      phase.y.push_back(phase.nodes[node.node].multiplier);
    phase.y.insert(phase.y.end(), phase.rigid.begin(), phase.rigid.end());
    const auto size = static_cast<int>(phase.y.size());
    std::vector<Eigen::Triplet<double>> u_by_y, y_by_u, worn_by_u;
    phase.y_by_y.setZero(size, size);
    phase.worn_by_y.setZero(count, size);
    phase.a_m.setZero(count);
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < size; ++j)
        if (k == j || k >= count || j >= count)
          phase.y_by_y(k, j) = entries_.at(phase.y[k], phase.y[j]);
    for (int k = 0; k < count; ++k) {
      const ClosedNode& node = phase.closed[k];
      const NodeUnknowns& u = phase.nodes[node.node].u;
      for (int j = k; j < size; j = std::max(j + 1, count))  // its own multiplier, and w
        for (int i = 0; i < most_components; ++i) {
          const int row = most_components * k + i;
          u_by_y.emplace_back(row, j, entries_.at(u[i], phase.y[j]));
          y_by_u.emplace_back(j, row, entries_.at(phase.y[j], u[i]));
        }
      if (node.on.surface < 0) continue;
      const NodeUnknowns& surface = entries_.surfaces()[node.on.surface];
      const NodeValues& m = direction[node.on.surface];
      phase.a_m[k] = node.on.a.dot(m);
      phase.worn_by_y(k, k) = node.on.e.dot(m);
      for (int c = 0; c < most_components; ++c) {
        for (int j = count; j < size; ++j)
          phase.worn_by_y(k, j) += m[c] * entries_.at(surface[c], phase.y[j]);
        for (int i = 0; i < most_components; ++i)
          worn_by_u.emplace_back(k, most_components * k + i, m[c] * entries_.at(surface[c], u[i]));
      }
    }
    const auto make = [](auto& matrix, int rows, int columns, const auto& entries) {
      matrix.resize(rows, columns);
      matrix.setFromTriplets(entries.begin(), entries.end());
    };
    make(phase.u_by_y, most_components * count, size, u_by_y);
    make(phase.y_by_u, size, most_components * count, y_by_u);
    make(phase.worn_by_u, count, most_components * count, worn_by_u);
  }

  ContactEntries entries_;
  std::vector<PhaseContact> phases_;
  std::vector<int> touching_;
  int worn_ = 0;
};

/// G = the part of K^-1 in rows and columns of the contact nodes' displacements, of which columns
/// are solved for when they are first needed, and kept until K is set up again.
class ContactCompliance {
public:
  /// `nodes`: of every contact node the numbers of its displacements in the block.
  explicit ContactCompliance(std::vector<NodeUnknowns> nodes) : nodes_(std::move(nodes)) {
    clear();
  }

  void clear() {
    first_column_.assign(nodes_.size(), -1);
    G_.resize(most_components * static_cast<long>(nodes_.size()), 0);
  }
  /// How many columns solve() would have to solve for.
  long missing(const std::vector<int>& nodes) const {
    return most_components *
           std::ranges::count_if(nodes, [this](int node) { return first_column_[node] < 0; });
  }

  /// Makes the columns of these nodes available.
  void solve(const std::vector<int>& nodes, StiffnessBlock& stiffness) {
    constexpr long together = 20;  // nodes per solve
    std::vector<int> fresh;
    std::ranges::copy_if(nodes, std::back_inserter(fresh),
                         [this](int node) { return first_column_[node] < 0; });
    if (fresh.empty()) return;
    long column = G_.cols();
    G_.conservativeResize(Eigen::NoChange,
                          column + most_components * static_cast<long>(fresh.size()));
    Eigen::MatrixXd forces, moved;
    for (std::size_t start = 0; start < fresh.size(); start += together) {
      const long count = std::min<long>(together, static_cast<long>(fresh.size() - start));
      forces.setZero(stiffness.size(), most_components * count);
      moved.resizeLike(forces);
      for (long k = 0; k < count; ++k)
        for (int i = 0; i < most_components; ++i)
          if (const int number = nodes_[fresh[start + k]][i]; number >= 0)
            forces(number, most_components * k + i) = 1;
      const auto entries = static_cast<std::size_t>(forces.size());
      stiffness.solver().apply({forces.data(), entries}, {moved.data(), entries});
      for (long k = 0; k < count; ++k, column += most_components) {
        first_column_[fresh[start + k]] = static_cast<int>(column);
        for (std::size_t node = 0; node < nodes_.size(); ++node)
          for (int i = 0; i < most_components; ++i) {
            const int number = nodes_[node][i];
            for (int j = 0; j < most_components; ++j)
              G_(most_components * static_cast<long>(node) + i, column + j) =
                  number < 0 ? 0 : moved(number, most_components * k + j);
          }
      }
    }
  }

  /// G of these nodes, whose columns are available.
  Eigen::MatrixXd among(const std::vector<ClosedNode>& nodes) const {
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd result(most_components * count, most_components * count);
    for (Eigen::Index l = 0; l < count; ++l)
      for (Eigen::Index k = 0; k < count; ++k)
        result.block<most_components, most_components>(most_components * k, most_components * l) =
            G_.block<most_components, most_components>(most_components * long(nodes[k].node),
                                                       first_column_[nodes[l].node]);
    return result;
  }
  long columns() const { return G_.cols(); }

private:
  std::vector<NodeUnknowns> nodes_;
  std::vector<int> first_column_;  // in G_, of every node; -1: not available
  Eigen::MatrixXd G_;              // a row per component of every node
};

}  // namespace gnomon
