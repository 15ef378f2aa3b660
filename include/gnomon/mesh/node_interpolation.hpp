// Interpolation between two meshes of one body.
#pragma once

#include <vector>

namespace gnomon {

/// From a coarse mesh, whose nodes are nodes of the fine one too: the value at a fine node is the
/// sum of `weight` times the value at the coarse node, over the entries of its row.
struct NodeInterpolation {
  std::vector<int> kept;    ///< of each coarse node: its number on the fine mesh, ascending
  std::vector<int> start;   ///< fine nodes + 1 entries: rows
  std::vector<int> coarse;  ///< ascending in a row
  std::vector<double> weight;
};

}  // namespace gnomon
