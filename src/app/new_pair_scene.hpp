// The scene that `gnomon new` writes for a mesh of several bodies that touch each other.
#pragma once

#include <filesystem>
#include <gnomon/mesh/imported_body.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// The named groups of cells, if they are bodies of their own and the whole mesh. Else none.
std::vector<std::string> bodies_that_meet(const ImportedMesh& mesh);

/// Bodies that face each other nearest are pairs. One of each is held and moves; the others are
/// guided and pressed on it, along a coordinate direction. `names`: groups of cells, the bodies.
/// Throws InputError if none face each other.
template <int dim>
std::string new_pair_scene(const std::filesystem::path& mesh, std::optional<double> size,
                           const ImportedBody<dim>& body, const std::vector<std::string>& names);

}  // namespace gnomon::app
