// The mesh of a part as its result keeps it.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/model.hpp>

namespace gnomon {

/// The parts of a mesh that the body is made of, beside its nodes and cells.
template <int dim>
std::vector<MeshPart> stored_parts(const ImportedBody<dim>& part);

/// The part again, from its mesh with these. `file` is for messages, which InputError throws where
/// the grid has no parts.
template <int dim>
ImportedBody<dim> part_of_grid(const Grid& grid, const std::string& file);

}  // namespace gnomon
