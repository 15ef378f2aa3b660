// The entries of a coupled Jacobian that belong to the closed contact nodes of several contact
// states at one shape, and the displacements of the contact nodes under unit forces at them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <utility>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// Indices of J are rows and columns; c are the shape unknowns of the surface node that the node
/// lies upon. What the pressure wears has one direction m at a surface node, in all phases.
struct ClosedNode {
  using Values = NodeValues;
  int node = 0;                                   ///< contact node
  int multiplier = 0;                             ///< number of l in J
  ContactEntries::OnSurface on = {};              ///< a and J_cl of its surface node
  Values B = Values::Zero(), L = Values::Zero();  ///< J_ul, J_lu
  double ll = 0;                                  ///< J_ll
  double a_m = 0, e_m = 0;                        ///< a.m, m.J_cl
  Values cu_m = Values::Zero();                   ///< m.J_cu
  /// With each of the rigid motions: J_lw, J_wl, m.J_cw; J_uw, J_wu by columns.
  Eigen::VectorXd lw = {}, wl = {}, cw_m = {};
  Eigen::Matrix3Xd uw = {}, wu = {};
};

/// A contact state.
struct PhaseContact {
  std::vector<ContactEntries::Node> nodes;
  std::vector<int> rigid;          ///< numbers of w
  std::vector<ClosedNode> closed;  ///< of the current J
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
    for (PhaseContact& phase : phases_) {
      phase.closed.clear();
      for (std::size_t c = 0; c < phase.nodes.size(); ++c)
        if (is_closed(phase.nodes[c])) {
          phase.closed.push_back(closed_node(phase, static_cast<int>(c)));
          touches[c] = 1;
        }
    }
    touching_.clear();
    for (std::size_t c = 0; c < touches.size(); ++c)
      if (touches[c]) touching_.push_back(static_cast<int>(c));
    find_wear_directions();
    for (PhaseContact& phase : phases_)
      for (ClosedNode& node : phase.closed) project(phase, node);
  }

  const std::vector<PhaseContact>& phases() const { return phases_; }
  /// Contact nodes that are closed in a phase, ascending.
  const std::vector<int>& touching() const { return touching_; }
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

  ClosedNode closed_node(const PhaseContact& phase, int number) const {
    const ContactEntries::Node& node = phase.nodes[number];
    ClosedNode closed{.node = number, .multiplier = node.multiplier};
    const int l = node.multiplier;
    for (int k = 0; k < most_components; ++k) {
      closed.B[k] = entries_.at(node.u[k], l);
      closed.L[k] = entries_.at(l, node.u[k]);
    }
    closed.ll = entries_.at(l, l);
    const auto count = static_cast<Eigen::Index>(phase.rigid.size());
    closed.lw.resize(count), closed.wl.resize(count), closed.cw_m.setZero(count);
    closed.uw.resize(3, count), closed.wu.resize(3, count);
    for (Eigen::Index r = 0; r < count; ++r) {
      const int w = phase.rigid[static_cast<std::size_t>(r)];
      closed.lw[r] = entries_.at(l, w);
      closed.wl[r] = entries_.at(w, l);
      for (int k = 0; k < most_components; ++k) {
        closed.uw(k, r) = entries_.at(node.u[k], w);
        closed.wu(k, r) = entries_.at(w, node.u[k]);
      }
    }
    closed.on = entries_.on_surface(node);
    return closed;
  }

  void find_wear_directions() {
    wear_direction_.assign(entries_.surfaces().size(), NodeValues::Zero());
    for (const PhaseContact& phase : phases_)
      for (const ClosedNode& node : phase.closed)
        if (node.on.surface >= 0) wear_direction_[node.on.surface] += node.on.e;
    for (NodeValues& m : wear_direction_)
      if (!m.isZero(0)) m.stableNormalize();
  }

  void project(const PhaseContact& phase, ClosedNode& node) const {
    if (node.on.surface < 0) return;
    const NodeUnknowns& surface = entries_.surfaces()[node.on.surface];
    const NodeValues& m = wear_direction_[node.on.surface];
    node.a_m = node.on.a.dot(m);
    node.e_m = node.on.e.dot(m);
    for (int k = 0; k < most_components; ++k) {
      for (std::size_t r = 0; r < phase.rigid.size(); ++r)
        node.cw_m[static_cast<Eigen::Index>(r)] += m[k] * entries_.at(surface[k], phase.rigid[r]);
      for (int i = 0; i < most_components; ++i)
        node.cu_m[i] += m[k] * entries_.at(surface[k], phase.nodes[node.node].u[i]);
    }
  }

  ContactEntries entries_;
  std::vector<PhaseContact> phases_;
  std::vector<NodeValues> wear_direction_;  // m, by surface node
  std::vector<int> touching_;
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

  /// Displacement of `node` under unit forces at `loaded`, whose columns are available.
  NodeSquare at(int node, int loaded) const {
    return G_.block<most_components, most_components>(most_components * static_cast<long>(node),
                                                      first_column_[loaded]);
  }
  long columns() const { return G_.cols(); }

private:
  std::vector<NodeUnknowns> nodes_;
  std::vector<int> first_column_;  // in G_, of every node; -1: not available
  Eigen::MatrixXd G_;              // a row per component of every node
};

}  // namespace gnomon
