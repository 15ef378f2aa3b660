// Loads on named parts of the boundary, each with a history of its own.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// Keys of `[[load]]`.
std::vector<Key> load_keys();

/// What is wrong in [[load]] whatever the mesh is.
void find_mistakes_of_loads(const Scene& scene, Mistakes& mistakes);

/// Throws InputError.
template <int dim>
std::vector<Load<dim>> read_loads(const Scene& scene, const ImportedBody<dim>& part,
                                  const std::vector<Body>& bodies);

}  // namespace gnomon::part
