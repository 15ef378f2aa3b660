// The process that uses Gmsh's library (src/gmsh): its faults are not those of gnomon.
#pragma once

#include <gnomon/mesh/mesh_file.hpp>

namespace gnomon {

/// Reads or meshes a file that can be read, or takes the mesh that another process of the same
/// study has made of it (shared_meshes.hpp). Throws InputError with Gmsh's first complaint, or
/// where this build has no Gmsh.
ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions& options);

}  // namespace gnomon
