// What problems of a worn hyperelastic body share in making it of a scene.
#pragma once

#include <gnomon/blocks/worn_body.hpp>
#include <gnomon/memory_estimate.hpp>
#include <gnomon/scene.hpp>
#include <string>

namespace gnomon {

/// Fills in what worn_body_keys() say: materials, element, wear, contact and the form of the shape
/// constraint. `facet` is a typical length of a contact facet; body.mesh and body.scales must be
/// given.
template <int dim>
void read_worn_body(const Scene& scene, double facet, WornBody<dim>& body);

/// The `solver.*` keys, and what the size of the mesh decides.
LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh);

/// Nodal dead loads of a uniform traction on a boundary part, of the given resultant.
NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part,
                           const Vector<2>& resultant);

}  // namespace gnomon
