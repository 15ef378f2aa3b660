// The entries of a coupled Jacobian that belong to the closed contact nodes of several contact
// states at one shape.
#pragma once

#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

#include "linear/contact_entries.hpp"

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
      phases_[structure.blocks[structure.block[i]].owner].rigid.push_back(i);
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

}  // namespace gnomon
