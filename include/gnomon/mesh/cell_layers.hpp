// The grid lines of a mesh, found from its connectivity alone.
#pragma once

#include <array>
#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

/// Layers of cells and how they are stacked. Opposite edges of a cell belong to the same layer (a
/// "sheet" of the mesh), which is one cell thick. Two layers are neighbours where all nodes of a
/// side of one are those of a side of the other; grid lines cross both. A structured block has one
/// stack of layers for each direction, however it is curved and graded; a body of several blocks
/// may have more; an unstructured mesh has stacks of a single layer.
struct CellLayers {
  /// A grid line that passes a node which lies between two layers of a stack.
  struct Passage {
    int stack = -1;             ///< -1: none
    int place = 0;              ///< the node lies between layers place - 1 and place
    int before = 0, after = 0;  ///< the next nodes on the line, in layers place - 1 and place
  };
  using Passages = std::array<Passage, 3>;

  std::vector<std::vector<double>> thickness;  ///< of each stack, its layers in order [length]
  std::vector<Passages> passages;              ///< of each node; those that exist come first
};

/// The thickness of a layer is the mean length of its edges. A layer that touches itself, and one
/// without two sides, is a stack of its own; a closed ring of layers is cut at one place.
template <int dim>
CellLayers cell_layers(const Mesh<dim>& mesh);

}  // namespace gnomon
