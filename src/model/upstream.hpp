// In steady rolling: from where material comes to the nodes of a surface.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <utility>
#include <vector>

namespace gnomon {

/// The derivative of a nodal value f along a streamline is (f - sum factor f(from)) / distance, of
/// second order in the size of facets; of first order at the second node of a line.
struct Upstream {
  int node = -1;                             ///< of the mesh
  std::vector<std::pair<int, double>> from;  ///< nodes of the mesh, with their factors
  double distance = 0;                       ///< [length]
  /// The difference between this derivative and that by the nodes on both sides is the sum of
  /// f(node) times these [1 / length]; at the ends of a line there is none.
  std::vector<std::pair<int, double>> upwind = {};
};

/// How far the material has come to the node since it was upstream: X - sum factor X(from)
/// [length].
template <int dim>
Vector<dim> streamed(const Mesh<dim>& mesh, const Upstream& at);

/// Of all nodes of tracks that carry a multiplier, but for the first of each line, along the
/// velocity of the rolling.
template <int dim>
std::vector<Upstream> upstream_of(const Assembly<dim>& assembly);

}  // namespace gnomon
