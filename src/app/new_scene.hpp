// The scene that `gnomon new` writes for a mesh of one body.
#pragma once

#include <filesystem>
#include <gnomon/mesh/imported_body.hpp>
#include <optional>
#include <string>

namespace gnomon::app {

/// Names the parts of the mesh and has every table that a scene needs, with numbers to be replaced.
/// A flat part is held; another one is met by a plane that touches it where it reaches farthest
/// along its mean normal. `mesh`: from the folder of the scene. `size`: of the
/// elements of a geometry [mm].
template <int dim>
std::string new_scene(const std::filesystem::path& mesh, std::optional<double> size,
                      const ImportedBody<dim>& body);

}  // namespace gnomon::app
