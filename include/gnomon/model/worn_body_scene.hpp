// The common part of making a worn hyperelastic body from a scene.
#pragma once

#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon {

/// Fills in the values of worn_body_keys(): materials, element, load history, wear, contact and the
/// form of the shape constraint; moves the counter-body away by the initial gap. `facet` is a
/// typical length of a contact facet; body.mesh, body.scales and the counter-body, touching the
/// body, must be given. Throws InputError like read_load_history().
template <int dim>
void read_worn_body(const Scene& scene, double facet, WornBody<dim>& body);

/// The nodes of a contact surface. If the scene chooses the conservative normal, they also know the
/// facets outside the surface that they move when they wear.
template <int dim>
std::vector<ContactPatch<dim>> read_contact_patches(
    const Scene& scene, const Mesh<dim>& mesh,
    const std::vector<typename Mesh<dim>::Facet>& surface);

/// `load.times` and `load.factors`. Throws InputError if they do not define a history.
LoadHistory read_load_history(const Scene& scene);

/// The integral of the force over the run [force time]: wear is proportional to it.
double load_impulse(const Scene& scene);

/// The choice by the `solver.*` keys and the size of the mesh.
LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh);

/// Nodal dead loads of a uniform traction on a boundary part, of the given resultant.
NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part,
                           const Vector<2>& resultant);

}  // namespace gnomon
