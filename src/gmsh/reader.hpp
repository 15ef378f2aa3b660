// Reads or meshes a file by Gmsh, in a process of its own.
#pragma once

#include <string>

namespace gnomon::gmsh_reader {

/// Writes the mesh, or why there is none, on mesh_stream::descriptor. A size of 0 is none, `zone`
/// that of ask_for_zone(), empty for none. Returns the exit code of the process.
int hand_over_mesh(const std::string& file, double size, double factor, const std::string& zone);

}  // namespace gnomon::gmsh_reader
