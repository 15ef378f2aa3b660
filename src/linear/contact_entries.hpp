// What a coupled Jacobian has at contact nodes and at the surface nodes that they lie upon.
#pragma once

#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

#include "linear/node_values.hpp"

namespace gnomon {

/// Indices of J are rows and columns: u displacements of a contact node, l its multiplier, c the
/// shape unknowns with one number of Structure::group (of a surface node, or of a line of a
/// groove).
class ContactEntries {
public:
  struct Node {
    int multiplier = 0;          ///< number of l in J
    int state = 0;               ///< the contact state (Structure::blocks, owner)
    int number = 0;              ///< among the nodes of its state
    NodeUnknowns u{-1, -1, -1};  ///< the node's own displacements
  };
  /// The surface node that the gap of a contact node contains.
  struct OnSurface {
    int surface = -1;                   ///< -1: none, as in a system without a shape
    NodeValues a = NodeValues::Zero();  ///< J_lc J_cc^-1, with the block of this surface node alone
    NodeValues e = NodeValues::Zero();  ///< J_cl
  };

  /// `structure` must outlive the object. All contact states have the same nodes in the same order.
  explicit ContactEntries(const Structure& structure);

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J);

  /// Of J; 0 where the pattern has none, and for numbers below 0.
  double at(int row, int column) const;
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Shape unknowns of all surface nodes.
  const std::vector<NodeUnknowns>& surfaces() const { return surfaces_; }
  OnSurface on_surface(const Node& node) const;
  /// a.s_c of a contact node.
  double shape_part(const OnSurface& on, std::span<const double> s) const;

private:
  NodeSquare inverse_at(const NodeUnknowns& surface) const;
  void find_surfaces(std::vector<int>& surface_of_group);
  void find_nodes(const std::vector<int>& surface_of_group);

  const Structure& structure_;
  std::span<const double> J_;
  std::vector<Node> nodes_;
  std::vector<NodeUnknowns> surfaces_;
  std::vector<NodeSquare> inverses_;  // J_cc^-1, by surface node
  // Surface nodes that the row of l may contain, by number of the contact node in its state.
  std::vector<std::vector<int>> candidates_;
};

}  // namespace gnomon
