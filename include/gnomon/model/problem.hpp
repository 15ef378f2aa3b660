// A problem is a declaration: its name, its scene keys and a function that makes a model from a
// scene.
#pragma once

#include <functional>
#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/scene/registry.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

struct Problem {
  std::string name;       ///< "pin_on_flat"
  std::string help;       ///< one line
  std::vector<Key> keys;  ///< all keys except run_keys()
  /// Throws InputError (using Scene::where) if keys contradict each other.
  std::function<std::unique_ptr<Model>(const Scene&)> make;
  /// Where meshes come from files: the model made again from the mesh that a result keeps.
  std::function<std::unique_ptr<Model>(const Scene&, const Grid&)> remake = nullptr;
  /// For problems with a mesh: its size, computed without making it.
  std::function<MeshSize(const Scene&)> mesh_size = nullptr;
  /// Further keys, those of other registered things; asked for when all are registered.
  std::function<std::vector<Key>()> registered_keys = nullptr;
  /// For a scene with mistaken keys, of which no model is made: what else is wrong in the rest of
  /// it, where required keys may have no value.
  std::function<void(const Scene&, Mistakes&)> further_mistakes = nullptr;

  std::string missing() const { return make ? "" : "make"; }  ///< for Registry
};

using Problems = Registry<Problem>;

/// Memory that a run of the scene will take [bytes]; 0 for a problem without a mesh.
double estimated_memory(const Scene& scene);

/// The model of a scene. Throws InputError like make(), and, before anything is allocated, if a run
/// would need more memory than is available.
std::unique_ptr<Model> make_model(const Scene& scene);

/// The model of a scene and of the mesh that its result keeps.
std::unique_ptr<Model> remake_model(const Scene& scene, const std::optional<Grid>& grid);

/// Adds what else is wrong in a scene with mistaken keys.
void find_further_mistakes(const Scene& scene, Mistakes& mistakes);

/// The problem's keys, with the choice of registered materials and their keys filled in.
std::vector<Key> own_keys(const Problem& problem);

/// Key table of a problem for load_scene: run_keys() followed by own_keys().
std::vector<Key> key_table(const std::string& problem);

}  // namespace gnomon
