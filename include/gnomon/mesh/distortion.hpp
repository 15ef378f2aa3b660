// Meshes that are distorted on purpose, to see what a result owes to the shape of its elements.
#pragma once

#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// Displaces every node off the named boundary parts, each component by up to `amount` times the
/// shortest edge at the node, to either side and the same on every machine. Below 1/4 rectangles
/// stay convex; beyond that cells may end up inverted.
template <int dim>
void distort(Mesh<dim>& mesh, double amount);

}  // namespace gnomon
