// The mesh of Gmsh's current model, made of its geometry where it has none, as gnomon's.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::gmsh_reader {

/// What gnomon does not take, in gnomon's words.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Tags of the geometrical entities of the current model, and Gmsh's numbers of the types of its
/// elements.
std::vector<int> entities_of(int dimension);
std::vector<int> element_types(int dimension);

/// Copies nodes, elements of the highest two dimensions and groups. Of a geometry with physical
/// groups of its highest dimension, only their cells, as Gmsh would save them.
void copy_model(ImportedMesh& mesh, bool geometry);

/// Before a geometry is opened: a script may read Mesh.MeshSizeFactor, for the numbers of elements
/// of a structured mesh, which sizes do not change.
void ask_for_factor(double factor);

/// A FineZone as text: size, then centre and radius of each ball.
void ask_for_zone(const std::string& zone);

/// The number of elements on all curves of the current model, which is left without a mesh.
double elements_on_curves();

/// Whether sizes set the number of elements on some curve of the current model, which is left
/// without a mesh.
bool curves_follow_sizes();

/// Meshes the current model with quadrilaterals (hexahedra) of first order. `size` as
/// MeshFileOptions has it. Without options of its own, as a script has them, a geometry gets
/// elements that follow its curvature. Says in `remarks` what the user may not expect.
void mesh_geometry(double size, double factor, bool has_options, std::vector<std::string>& remarks);

}  // namespace gnomon::gmsh_reader
