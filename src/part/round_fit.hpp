// Bodies with round surfaces that lie in each other, as a shaft in the bore of a hub.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon::part {

/// Facets are chords of round surfaces: where those of the two sides are of different length, they
/// overlap by more, or less, than these. Tells it in the remarks where it changes the pressure of a
/// fit. `x`: of the nodes, in space, by pair, where the meshes lie: loads press bodies into each
/// other.
template <int dim>
void tell_round_fits(const ImportedBody<dim>& part, const std::vector<std::vector<Vector<dim>>>& x,
                     AssemblyParts<dim>& parts);

}  // namespace gnomon::part
