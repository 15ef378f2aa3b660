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
  PhaseContacts(const Structure& structure, std::size_t phases);

  void update(std::span<const double> J);

  const std::vector<PhaseContact>& phases() const { return phases_; }
  /// Contact nodes that are closed in a phase, ascending.
  const std::vector<int>& touching() const { return touching_; }
  const ContactEntries& entries() const { return entries_; }

private:
  bool is_closed(const ContactEntries::Node& node) const;
  ClosedNode closed_node(const PhaseContact& phase, int node) const;
  void find_wear_directions();
  void project(const PhaseContact& phase, ClosedNode& node) const;

  ContactEntries entries_;
  std::vector<PhaseContact> phases_;
  std::vector<NodeValues> wear_direction_;  // m, by surface node
  std::vector<int> touching_;
};

}  // namespace gnomon
