// The mesh of a scene: one file, or a file for each body.
#pragma once

#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/scene/scene.hpp>
#include <vector>

namespace gnomon::part {

/// Keys of [[body]] for meshes of its own.
std::vector<Key> body_mesh_keys();

/// Whether Gmsh makes the mesh, or one of the meshes, from a geometry.
bool has_geometry(const Scene& scene);

/// The mesh of mesh.file, or those of body.#.mesh, one after the other: the cells of each are the
/// group that its body names. Where groups of facets or points in two files have one name, the body
/// goes before it, as in "pin.top". `fine` is of the bodies where the scene has them. Throws
/// InputError.
ImportedMesh read_mesh(const Scene& scene, const FineZone& fine = {});

}  // namespace gnomon::part
