// What holds a part: supports of the displacement by name.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// Keys of `[[support]]`.
std::vector<Key> support_keys();

/// Positions of the directions that a support, "support.1", names, or of all. Throws InputError.
template <int dim>
std::vector<int> directions_of(const Scene& scene, const std::string& support);

/// What is wrong in [[support]] whatever the mesh is.
void find_mistakes_of_supports(const Scene& scene, Mistakes& mistakes);

/// Also what the axis of a body of revolution holds. Throws InputError.
template <int dim>
Supports<dim> read_supports(const Scene& scene, const ImportedBody<dim>& part);

}  // namespace gnomon::part
