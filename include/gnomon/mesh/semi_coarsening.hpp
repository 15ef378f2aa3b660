// Ever coarser meshes for geometric multigrid, made along the grid lines of the finest, which are
// found from its connectivity alone; and interpolation between them.
#pragma once

#include <array>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/mesh/node_interpolation.hpp>
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

/// Which layers become one from level to level.
struct CoarseningRule {
  /// Level l merges, in every stack, pairs of neighbouring layers that are both thinner than
  /// `slenderness` * 2^l * the thinnest of all: thin layers first, so that cells become cubes.
  double slenderness = 3;
  /// A limit at which more than this part of the nodes would stay is skipped.
  double most_kept = 0.75;
  /// Coarsening ends below this number of nodes.
  std::size_t few = 200;
  /// Where more nodes are left at the end, lines in some direction are missing.
  std::size_t many = 1000;
};

/// Interpolations between one mesh and the next coarser, from the finest on, along grid lines and
/// linear in the distances on them (trilinear in a block). Empty where the mesh is small, and where
/// it has too few grid lines for `many`.
template <int dim>
std::vector<NodeInterpolation> semi_coarsening(const Mesh<dim>& mesh,
                                               const CoarseningRule& rule = {});

}  // namespace gnomon
