// What problems of a worn hyperelastic body share in making it of a scene.
#pragma once

#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon {

/// Fills in what worn_body_keys() say: materials, element, load history, contact and the form of
/// the shape constraint; moves the counter-body away by the initial gap. `facet` is a typical
/// length of a contact facet. body.mesh, body.contact_nodes, body.contact.wear, body.scales and the
/// counter-body, touching, must be given. Throws InputError where read_load_history() does, or
/// require_law() of the wear law.
template <int dim>
void read_worn_body(const Scene& scene, double facet, WornBody<dim>& body);

/// The nodes of a contact surface. Where the scene asks for the normal that conserves volume they
/// know the facets beyond the surface, too, which they move when they wear.
template <int dim>
std::vector<ContactPatch<dim>> read_contact_patches(
    const Scene& scene, const Mesh<dim>& mesh,
    const std::vector<typename Mesh<dim>::Facet>& surface);

/// `load.times` and `load.factors`. Throws InputError when they are no history.
LoadHistory read_load_history(const Scene& scene);

/// The integral of the force over the run [force time]: wear is proportional to it.
double load_impulse(const Scene& scene);

/// The `solver.*` keys, and what the size of the mesh decides.
LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh);

/// Nodal dead loads of a uniform traction on a boundary part, of the given resultant.
NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part,
                           const Vector<2>& resultant);

}  // namespace gnomon
