// A part of one's own: from a mesh with named surfaces, and the scene that names them.
#pragma once

#include <gnomon/base/mistakes.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <vector>

namespace gnomon {

/// All keys but run_keys() and those of the counter-body. One table for parts in the plane and in
/// space, for the mesh tells which it is: arrays that have a number for each direction are of any
/// length here.
std::vector<Key> part_keys();

/// The groups of cells that are bodies of their own, by [[pair]].
std::vector<std::string> separate_bodies(const Scene& scene);

/// What the scene says of this mesh. Throws InputError, or InputErrors with all mistakes that can
/// be found without solving anything.
template <int dim>
AssemblyParts<dim> read_part(const Scene& scene, const ImportedBody<dim>& part);

/// The model of a scene, whose mesh is read from its file.
std::unique_ptr<Model> make_part(const Scene& scene);
/// Of the mesh that a result keeps.
std::unique_ptr<Model> remake_part(const Scene& scene, const Grid& grid);
/// Where keys are mistaken, names of groups can be looked up all the same.
void find_mistakes_of_groups(const Scene& scene, Mistakes& mistakes);

}  // namespace gnomon
