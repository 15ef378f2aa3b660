// Where supports that move carry the bodies of pairs.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon::part {

/// The nodes of the mesh, and those of bodies that supports have carried as a whole: where the
/// histories of these begin, turn and end, and at some places between [length].
template <int dim>
std::vector<std::vector<Vector<dim>>> carried_meshes(const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
