// The mesh of Gmsh's current model as gnomon's.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>
#include <stdexcept>

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

}  // namespace gnomon::gmsh_reader
