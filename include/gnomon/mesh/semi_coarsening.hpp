// Ever coarser meshes for geometric multigrid, and interpolation between them.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <gnomon/mesh/node_interpolation.hpp>
#include <vector>

namespace gnomon {

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
