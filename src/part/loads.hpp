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

/// Those without a factor of their own over the cycle. Throws InputError.
template <int dim>
std::vector<Load<dim>> read_loads(const Scene& scene, const ImportedBody<dim>& part,
                                  const std::vector<Body>& bodies);

/// Those with one. Throws InputError.
template <int dim>
std::vector<Load<dim>> read_swinging_loads(const Scene& scene, const ImportedBody<dim>& part,
                                           const std::vector<Body>& bodies);

/// The factors of these. Throws InputError where friction may not stick.
std::vector<CycleFunction> factors_of_loads(const Scene& scene);

}  // namespace gnomon::part
