// The mesh of Gmsh's current model as gnomon's.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>
#include <stdexcept>

namespace gnomon::gmsh_reader {

/// What gnomon does not take, in gnomon's words.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Copies nodes, elements of the highest two dimensions and groups. Of a geometry with physical
/// groups of its highest dimension, only their cells, as Gmsh would save them.
void copy_model(ImportedMesh& mesh, bool geometry);

}  // namespace gnomon::gmsh_reader
