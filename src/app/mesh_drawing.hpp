// What `gnomon mesh -o` writes.
#pragma once

#include <filesystem>
#include <gnomon/mesh/imported_body.hpp>

namespace gnomon::app {

/// Throws InputError for another ending than .png, .svg or .xdmf, a folder that is not there, and
/// an .xdmf file that is not gnomon's and would be replaced.
void check_drawing(const std::filesystem::path& file);

/// A picture of the mesh and its named parts, or the same for ParaView. `axes`: names of the
/// coordinates, "x y". Throws InputError, and Error without Python or its packages.
template <int dim>
void draw_mesh(const ImportedBody<dim>& body, const std::string& axes,
               const std::filesystem::path& file);

}  // namespace gnomon::app
