// Meshes of geometries.
#pragma once

#include <string>
#include <vector>

namespace gnomon::gmsh_reader {

/// Before a geometry is opened: a script may read Mesh.MeshSizeFactor, for the numbers of elements
/// of a structured mesh, which sizes do not change.
void ask_for_factor(double factor);

/// The number of elements on all curves of the current model, which is left without a mesh.
double elements_on_curves();

/// Meshes the current model with quadrilaterals (hexahedra) of first order. `size` as
/// MeshFileOptions has it. Without options of its own, as a script has them, a geometry gets
/// elements that follow its curvature. Says in `remarks` what the user may not expect.
void mesh_geometry(double size, double factor, bool has_options, std::vector<std::string>& remarks);

}  // namespace gnomon::gmsh_reader
