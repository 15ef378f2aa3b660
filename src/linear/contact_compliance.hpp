// Displacements of the contact nodes of an elastic body under unit forces at these nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear/node_values.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// G = the part of K^-1 in rows and columns of the contact nodes' displacements, of which columns
/// are solved for when they are first needed, and kept until K is set up again.
class ContactCompliance {
public:
  /// `nodes`: of every contact node the numbers of its displacements in the block.
  explicit ContactCompliance(std::vector<NodeUnknowns> nodes);

  void clear();
  /// How many columns solve() would have to solve for.
  long missing(const std::vector<int>& nodes) const;
  /// Makes the columns of these nodes available.
  void solve(const std::vector<int>& nodes, StiffnessBlock& stiffness);
  /// Displacement of `node` under unit forces at `loaded`, whose columns are available.
  NodeSquare at(int node, int loaded) const;
  long columns() const { return G_.cols(); }

private:
  std::vector<NodeUnknowns> nodes_;
  std::vector<int> first_column_;  // in G_, of every node; -1: not available
  Eigen::MatrixXd G_;              // a row per component of every node
};

}  // namespace gnomon
