// Meshes that are distorted on purpose, to find how results depend on the shape of elements.
#pragma once

#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// Displaces every node that is not on a named boundary part, each component by up to `amount`
/// times the shortest edge at the node, in either direction and in the same way on every machine.
/// Below 1/4 rectangles stay convex; above that cells may become inverted.
template <int dim>
void distort(Mesh<dim>& mesh, double amount);

}  // namespace gnomon
