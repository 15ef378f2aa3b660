// What pairs cannot have to the accuracy of their mesh.
#pragma once

#include <gnomon/model/assembly.hpp>

namespace gnomon::part {

/// Where two surfaces that wear meet at an edge, a node has one normal and one pressure for both.
template <int dim>
void tell_of_edges(AssemblyParts<dim>& parts);

/// Where bodies turn about a point at which they touch, speed falls to nothing within a facet.
template <int dim>
void tell_of_turning(AssemblyParts<dim>& parts);

}  // namespace gnomon::part
