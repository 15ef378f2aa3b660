// Half a body is right only where all that happens to it has its symmetry, too.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <string>
#include <vector>

namespace gnomon::part {

/// Where a plane that a support holds across, as that of a symmetry, cuts the contact, and friction
/// acts across it.
template <int dim>
std::vector<std::string> remarks_on_symmetry(const AssemblyParts<dim>& parts,
                                             const Magnitudes& expected);

}  // namespace gnomon::part
