// The process that uses Gmsh, from the side of gnomon.
#pragma once

#include <filesystem>
#include <gnomon/mesh/mesh_file.hpp>

namespace gnomon {

/// Starts the process, takes what it hands over and waits for its end. Throws InputError.
ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions& options);

}  // namespace gnomon
