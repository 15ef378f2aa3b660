// A mesh that is fine where the bodies are expected to touch.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>

namespace gnomon::part {

/// The mesh of the scene; with mesh.contact_size of a geometry that is meshed again where the run
/// is expected to bring the bodies into contact. Throws InputError.
ImportedMesh read_graded_mesh(const Scene& scene);

/// With a mesh.contact_size of a twentieth of the contact that is expected, or of the sizes there
/// that the geometry gives where they are smaller. Nothing where the scene gives mesh.factor or
/// mesh.contact_size, or the geometry fixes the number of elements of the contact.
std::optional<Scene> with_contact_size(const Scene& scene);

}  // namespace gnomon::part
