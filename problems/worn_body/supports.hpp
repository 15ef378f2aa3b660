// What holds a part: supports of the displacement by name, and supports of the shape, most of which
// follow from the geometry.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// Keys of `[[support]]`.
std::vector<Key> support_keys();

/// Positions of the directions that a support, "support.1", names, or of all. Throws InputError.
template <int dim>
std::vector<int> directions_of(const Scene& scene, const std::string& support);

/// What is wrong in [[support]] whatever the mesh is.
void find_mistakes_of_supports(const Scene& scene, Mistakes& mistakes);

/// Fills in displacement_fixed, prescribed_displacement, and springs among the added terms. Throws
/// InputError.
template <int dim>
void read_supports(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body);

/// Throws InputError where supports, springs and the contact leave the body free to move as a
/// whole, and says how.
template <int dim>
void require_held(const Scene& scene, const ImportedBody<dim>& part, const WornBody<dim>& body);

}  // namespace gnomon::part
