// The entries of a coupled Jacobian that belong to the closed contact nodes of several contact
// states at one shape.
#pragma once

#include <array>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

#include "linear/contact_compliance.hpp"

namespace gnomon {

/// Indices of J are rows and columns; c are the shape unknowns of the surface node that the node
/// lies upon. What the pressure wears has one direction m at a surface node, in all phases.
struct ClosedNode {
  using Values = ContactCompliance::Values;
  int node = 0;                                   ///< contact node
  int multiplier = 0;                             ///< number of l in J
  int surface = -1;                               ///< its surface node; -1: the system has no shape
  Values B = Values::Zero(), L = Values::Zero();  ///< J_ul, J_lu
  double ll = 0, lw = 0, wl = 0;                  ///< J_ll, J_lw, J_wl
  Values uw = Values::Zero(), wu = Values::Zero();  ///< J_uw, J_wu
  Values a = Values::Zero();                        ///< J_lc J_cc^-1
  Values e = Values::Zero();                        ///< J_cl
  double a_m = 0, e_m = 0, cw_m = 0;                ///< a.m, m.J_cl, m.J_cw
  Values cu_m = Values::Zero();                     ///< m.J_cu
};

/// A contact state.
struct PhaseContact {
  struct Node {
    int multiplier = 0;
    std::array<int, ContactCompliance::most> u{-1, -1, -1};  ///< numbers in J, -1: held
  };
  std::vector<Node> nodes;         ///< by contact node
  int rigid = -1;                  ///< number of w; -1: none
  std::vector<ClosedNode> closed;  ///< of the current J
};

class PhaseContacts {
public:
  using Values = ContactCompliance::Values;
  /// `structure` must outlive the object.
  PhaseContacts(const Structure& structure, std::size_t phases);

  void update(std::span<const double> J);

  const std::vector<PhaseContact>& phases() const { return phases_; }
  /// Contact nodes that are closed in a phase, ascending.
  const std::vector<int>& touching() const { return touching_; }
  std::size_t surfaces() const { return surfaces_.size(); }
  /// a.s_c of a closed node.
  double shape_part(const ClosedNode& node, std::span<const double> s) const;

private:
  struct Surface {
    std::array<int, ContactCompliance::most> unknowns{-1, -1, -1};
    ContactCompliance::Square inverse;  ///< J_cc^-1 of this node alone
    Values m = Values::Zero();
  };
  double entry(int row, int column) const;
  bool is_closed(const PhaseContact::Node& node) const;
  ClosedNode closed_node(const PhaseContact& phase, int node) const;
  void update_surfaces();
  void find_wear_directions();
  void project(const PhaseContact& phase, ClosedNode& node) const;

  const Structure& structure_;
  std::span<const double> J_;
  std::vector<PhaseContact> phases_;
  std::vector<Surface> surfaces_;
  std::vector<std::vector<int>> candidates_;  // surfaces whose shape a multiplier's row may contain
  std::vector<int> touching_;
};

}  // namespace gnomon
