// A mesh as text for other programs.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <string>

namespace gnomon {

/// The mesh of a body with its groups, in the format of Gmsh that most programs read: 2.2, ASCII.
/// Positions are written such that reading gives the same numbers. A cell of several groups is in
/// the first of them; a facet of several is listed in each.
template <int dim>
std::string gmsh_text(const ImportedBody<dim>& body);

}  // namespace gnomon
