// Loads on named parts of the boundary, each with a history of its own.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// Keys of `[[load]]`.
std::vector<Key> load_keys();

/// What is wrong in [[load]] whatever the mesh is.
void find_mistakes_of_loads(const Scene& scene, Mistakes& mistakes);

/// Adds a term for each load; body.load stays zero. Returns the sum of the dead loads at factor one
/// [force], which is what presses a body on a counter-body that is at rest. Throws InputError.
template <int dim>
Vector<dim> read_loads(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body);

}  // namespace gnomon::part
