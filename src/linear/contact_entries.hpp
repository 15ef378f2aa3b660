// What a coupled Jacobian has at contact nodes and at the surface nodes that they lie upon.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

constexpr int most_components = 3;
/// Numbers of unknowns; -1 for components that the node lacks.
using NodeUnknowns = std::array<int, most_components>;
/// Zero for components that the node lacks.
using NodeValues = Eigen::Vector3d;
using NodeSquare = Eigen::Matrix3d;

inline NodeValues values_at(const NodeUnknowns& unknowns, std::span<const double> x) {
  NodeValues values = NodeValues::Zero();
  for (int k = 0; k < most_components; ++k)
    if (unknowns[k] >= 0) values[k] = x[unknowns[k]];
  return values;
}

/// Indices of J are rows and columns: u displacements of a contact node, l its multiplier, c the
/// shape unknowns with one number of Structure::group (of a surface node, or of a line of a
/// groove).
class ContactEntries {
public:
  struct Partner {
    int group = 0;  ///< Structure::group
    NodeUnknowns u{-1, -1, -1};
    int surface = -1;  ///< among surfaces(); -1: none
  };
  struct Node {
    int multiplier = 0;               ///< number of l in J
    int group = 0;                    ///< Structure::group
    int state = 0;                    ///< the contact state (Structure::blocks, owner)
    NodeUnknowns u{-1, -1, -1};       ///< the node's own displacements
    std::vector<Partner> partners{};  ///< nodes of another body that l may press
    std::vector<int> surfaces{};      ///< that its row may contain, among surfaces()
  };
  /// B and C of a contact node at one of the nodes that it moves.
  struct Share {
    int group;  ///< of that node
    NodeUnknowns u;
    NodeValues B, C;
  };
  /// A surface node that the gap of a contact node contains.
  struct OnSurface {
    int surface = -1;                   ///< -1: none, as in a system without a shape
    NodeValues a = NodeValues::Zero();  ///< J_lc J_cc^-1, with the block of this surface node alone
    NodeValues e = NodeValues::Zero();  ///< J_cl
  };

  /// `structure` must outlive the object.
  explicit ContactEntries(const Structure& structure) : structure_(structure) {
    std::vector<int> surface_of_group;
    find_surfaces(surface_of_group);
    find_nodes(surface_of_group);
    find_partners(surface_of_group);
    inverses_.resize(surfaces_.size());
    pressed_.resize(surfaces_.size());
  }

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J) {
    J_ = J;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) inverses_[s] = inverse_at(surfaces_[s]);
    std::ranges::fill(pressed_, NodeValues::Zero());
    for (const Node& node : nodes_)
      for (const Partner& partner : node.partners)
        if (partner.surface >= 0) pressed_[partner.surface] += wear_at(partner.surface, node);
  }

  /// Of J; 0 where the pattern has none, and for numbers below 0.
  double at(int row, int column) const {
    if (row < 0 || column < 0) return 0;
    const int position = structure_.pattern.find(row, column);
    return position < 0 ? 0 : J_[position];
  }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Shape unknowns of all surface nodes.
  const std::vector<NodeUnknowns>& surfaces() const { return surfaces_; }
  OnSurface on_surface(const Node& node) const {
    // The pattern of the row has the shape of all nodes around; of this body, the gap contains that
    // of one, which has nonzero entries.
    OnSurface result;
    double largest = 0;
    for (int candidate : node.surfaces) {
      if (std::ranges::find(node.partners, candidate, &Partner::surface) != node.partners.end())
        continue;
      const NodeValues row = gap_by(candidate, node);
      if (row.norm() <= largest) continue;
      largest = row.norm();
      result.surface = candidate;
      result.a = inverses_[candidate].transpose() * row;
    }
    if (result.surface >= 0) result.e = wear_at(result.surface, node);
    return result;
  }
  /// All surface nodes, of any body, whose shape the gap contains or that the pressure wears.
  std::vector<OnSurface> on_surfaces(const Node& node) const {
    std::vector<OnSurface> result;
    for (int candidate : node.surfaces) {
      const NodeValues row = gap_by(candidate, node), worn = wear_at(candidate, node);
      if (!row.isZero(0) || !worn.isZero(0))
        result.push_back({candidate, inverses_[candidate].transpose() * row, worn});
    }
    return result;
  }
  /// The same of the nodes of another body. They wear by the pressures of several contact nodes,
  /// which are taken for equal: e is their sum.
  std::vector<OnSurface> on_partners(const Node& node) const {
    std::vector<OnSurface> result;
    for (const Partner& partner : node.partners) {
      if (partner.surface < 0) continue;
      const NodeValues row = gap_by(partner.surface, node);
      if (!row.isZero(0))
        result.push_back({partner.surface, inverses_[partner.surface].transpose() * row,
                          pressed_[partner.surface]});
    }
    return result;
  }
  /// Of the node itself first, then of the nodes of another body.
  std::vector<Share> shares(const Node& node) const {
    std::vector<Share> result = {share(node, node.group, node.u)};
    for (const Partner& partner : node.partners)
      if (const Share at = share(node, partner.group, partner.u);
          !at.B.isZero(0) || !at.C.isZero(0))
        result.push_back(at);
    return result;
  }
  /// The displacements that springs may join, of each contact node that has partners.
  std::vector<std::vector<int>> joined() const {
    std::vector<std::vector<int>> result;
    const auto add = [&](const NodeUnknowns& u) {
      for (int k = 0; k < most_components; ++k)
        if (u[k] >= 0) result.back().push_back(u[k]);
    };
    for (const Node& node : nodes_) {
      if (node.partners.empty()) continue;
      result.emplace_back();
      add(node.u);
      for (const Partner& partner : node.partners) add(partner.u);
    }
    return result;
  }

  /// a.s_c of a contact node.
  double shape_part(const OnSurface& on, std::span<const double> s) const {
    return on.surface < 0 ? 0 : on.a.dot(values_at(surfaces_[on.surface], s));
  }

private:
  NodeValues gap_by(int surface, const Node& node) const {
    NodeValues row;
    for (int k = 0; k < most_components; ++k) row[k] = at(node.multiplier, surfaces_[surface][k]);
    return row;
  }
  NodeValues wear_at(int surface, const Node& node) const {
    NodeValues column;
    for (int k = 0; k < most_components; ++k)
      column[k] = at(surfaces_[surface][k], node.multiplier);
    return column;
  }
  Share share(const Node& node, int group, const NodeUnknowns& u) const {
    Share result{.group = group, .u = u, .B = {}, .C = {}};
    for (int k = 0; k < most_components; ++k) {
      result.B[k] = at(u[k], node.multiplier);
      result.C[k] = at(node.multiplier, u[k]);
    }
    return result;
  }

  NodeSquare inverse_at(const NodeUnknowns& surface) const {
    NodeSquare block = NodeSquare::Identity();
    for (int k = 0; k < most_components; ++k)
      for (int l = 0; l < most_components; ++l)
        if (surface[k] >= 0 && surface[l] >= 0) block(k, l) = at(surface[k], surface[l]);
    return block.inverse();
  }

  void find_surfaces(std::vector<int>& surface_of_group) {
    for (int i : unknowns_of(structure_, {Role::evolution})) {
      const auto group = static_cast<std::size_t>(structure_.group[i]);
      if (surface_of_group.size() <= group) surface_of_group.resize(group + 1, -1);
      if (surface_of_group[group] < 0) {
        surface_of_group[group] = static_cast<int>(surfaces_.size());
        surfaces_.push_back({-1, -1, -1});
      }
      surfaces_[surface_of_group[group]][structure_.component[i]] = i;
    }
  }

  void find_nodes(const std::vector<int>& surface_of_group) {
    const SparsePattern& pattern = structure_.pattern;
    std::vector<int> node_of(structure_.size, -1);
    for (int i : unknowns_of(structure_, {Role::multiplier})) {
      node_of[i] = static_cast<int>(nodes_.size());
      nodes_.push_back(
          {.multiplier = i, .group = structure_.group[i], .state = structure_.block_of(i).owner});
    }
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const int row = pattern.row_index[k];
        if (node_of[row] < 0) continue;
        Node& node = nodes_[node_of[row]];
        // The pattern may have the displacements around; the gap contains those of the node.
        if (structure_.block_of(j).role == Role::stiffness &&
            structure_.group[j] == structure_.group[row])
          node.u[structure_.component[j]] = j;
        if (structure_.block_of(j).role != Role::evolution) continue;
        const int surface = surface_of_group[structure_.group[j]];
        if (node.surfaces.empty() || node.surfaces.back() != surface)
          node.surfaces.push_back(surface);
      }
  }

  /// The force of l acts upon the node itself, and upon what it presses.
  void find_partners(const std::vector<int>& surface_of_group) {
    const SparsePattern& pattern = structure_.pattern;
    for (Node& node : nodes_) {
      int last = node.group;
      for (int k = pattern.column_start[node.multiplier];
           k < pattern.column_start[node.multiplier + 1]; ++k) {
        const int row = pattern.row_index[k], group = structure_.group[row];
        if (structure_.block_of(row).role != Role::stiffness || group == node.group) continue;
        if (group != last)  // unknowns are numbered node by node
          node.partners.push_back({.group = group});
        last = group;
        node.partners.back().u[structure_.component[row]] = row;
        if (static_cast<std::size_t>(group) < surface_of_group.size())
          node.partners.back().surface = surface_of_group[group];
      }
    }
  }

  const Structure& structure_;
  std::span<const double> J_;
  std::vector<Node> nodes_;
  std::vector<NodeUnknowns> surfaces_;
  std::vector<NodeSquare> inverses_;  // J_cc^-1, by surface node
  std::vector<NodeValues> pressed_;   // by surface node, the sum of J_cl where it is a partner's
};

}  // namespace gnomon
