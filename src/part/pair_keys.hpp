// What [[pair]] and [[motion]] say whatever the mesh is.
#pragma once

#include <gnomon/base/mistakes.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::part {

/// check_mesh() with what a scene says of the mesh. Throws InputError, also one that names the
/// [[pair]] of one body where the mesh has another one that is in no pair.
template <int dim>
ImportedBody<dim> check_bodies(const Scene& scene, ImportedMesh mesh, int splits);

/// Keys of `[[pair]]` and `[[motion]]`.
std::vector<Key> pair_keys();

/// The entries of [[pair]], "pair.1" and so on. Throws InputError.
std::vector<std::string> pair_tables(const Scene& scene);

/// Whether the bodies meet each other, and no counter-body.
bool has_pairs(const Scene& scene);

/// Whether friction may stick: in [[pair]], or friction.stick. Throws InputError where pairs
/// differ.
bool may_stick(const Scene& scene);

/// What is wrong in [[pair]] whatever the mesh is.
void find_mistakes_of_pairs(const Scene& scene, Mistakes& mistakes);

}  // namespace gnomon::part
