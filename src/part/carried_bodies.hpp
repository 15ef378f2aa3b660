// Where supports that move carry the bodies of pairs.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon::part {

/// The nodes of the mesh, and those of bodies that supports have carried as a whole until the time
/// `end`: where the histories of these begin and turn, and at some places between, as far as they
/// differ by more than 1/200 of the size of the mesh [length].
template <int dim>
std::vector<std::vector<Vector<dim>>> carried_meshes(const AssemblyParts<dim>& parts, double end);

}  // namespace gnomon::part
