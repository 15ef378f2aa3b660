// The common part of making a worn hyperelastic body from a scene.
#pragma once

#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon {

/// Fills in the values of worn_body_keys(): materials, element, load history, wear, contact and the
/// form of the shape constraint; moves the counter-body away by the initial gap. `facet` is a
/// typical length of a contact facet; body.mesh, body.scales and the counter-body, touching the
/// body, must be given. Throws InputError like read_load_history() and require_memory().
template <int dim>
void read_worn_body(const Scene& scene, double facet, WornBody<dim>& body);

/// What the wear laws of a body meet in a run, by its scales, its friction and its contact nodes.
template <int dim>
WearCircumstances wear_circumstances(const WornBody<dim>& body);

/// The nodes of a contact surface. If the scene chooses the conservative normal, they also know the
/// facets outside the surface that they move when they wear.
template <int dim>
std::vector<ContactPatch<dim>> read_contact_patches(
    const Scene& scene, const Mesh<dim>& mesh,
    const std::vector<typename Mesh<dim>::Facet>& surface, Section section = Section::plane);

/// Holds what a body of revolution cannot do: on the axis u_r = d_r = 0. To be called before
/// read_worn_body(). Throws InputError like axis_nodes().
void hold_on_axis(WornBody<2>& body);

/// The history of a force that keeps the bodies together, from `PREFIX.times` and `PREFIX.factors`.
/// Throws InputError if they do not define one.
LoadHistory read_load_history(const Scene& scene, const std::string& prefix = "load");

/// The integral of the force over the run [force time]: wear is proportional to it.
double load_impulse(const Scene& scene);

/// The choice by the `solver.*` keys and the size of the mesh.
LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh);

/// Throws InputError where a run by this solver needs more memory than is available.
void require_memory(const Scene& scene, const MeshSize& mesh, const LinearSolverChoice& solver);

/// Nodal dead loads of a uniform traction on a boundary part: its integral over the part is
/// `resultant` [force; per thickness of a plane body; of a body of revolution the part's area is
/// that of the whole circumference, so that the component r is no resultant].
NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part, const Vector<2>& resultant,
                           Section section = Section::plane);

/// Nodal dead loads of a uniform force per initial volume, like gravity [force / length^dim; per
/// length^3 in a body of revolution].
template <int dim>
NodalField<dim> volume_load(const Mesh<dim>& mesh, const Vector<dim>& density,
                            Section section = Section::plane);

}  // namespace gnomon
