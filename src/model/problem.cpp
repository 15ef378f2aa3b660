
#include <algorithm>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

namespace gnomon {

double estimated_memory(const Scene& scene) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (!problem.mesh_size) return 0;
  return estimated_memory(scene, problem.mesh_size(scene));
}

namespace {

/// In space, where the estimate by the keys is rough, only what is certainly too much is refused;
/// when the mesh exists, its memory is estimated again.
void require_memory_by_keys(const Scene& scene, const MeshSize& mesh) {
  if (mesh.dim == 3 && estimated_memory(scene, mesh) / 2 <= available_memory()) return;
  required_memory(scene, mesh);
}

}  // namespace

std::unique_ptr<Model> make_model(const Scene& scene) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (problem.mesh_size) require_memory_by_keys(scene, problem.mesh_size(scene));
  return problem.make(scene);
}

std::unique_ptr<Model> remake_model(const Scene& scene, const std::optional<Grid>& grid) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  return problem.remake && grid ? problem.remake(scene, *grid) : make_model(scene);
}

void find_further_mistakes(const Scene& scene, Mistakes& mistakes) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (problem.further_mistakes) problem.further_mistakes(scene, mistakes);
}

namespace {

/// Completes a table that has the key `choice` ("wear.law") by what is registered of T.
template <class T>
void add_registered(std::vector<Key>& table, const std::string& choice) {
  const auto place = std::ranges::find(table, choice, &Key::name);
  if (place == table.end()) return;
  place->choices = Registry<T>::names();
  for (const T& entry : Registry<T>::all())
    for (const Key& key : entry.keys) add_key_of_choice(table, key, choice, entry.name);
}

}  // namespace

std::vector<Key> own_keys(const Problem& problem) {
  std::vector<Key> keys = problem.keys;
  if (problem.registered_keys) {
    const std::vector<Key> more = problem.registered_keys();
    keys.insert(keys.end(), more.begin(), more.end());
  }
  for (const char* material : {"body.material", "body.#.material", "shape.energy"})
    add_material_keys(keys, material);
  add_registered<WearLawKind>(keys, "wear.law");
  add_registered<LinearSolverKind>(keys, "solver.method");
  return keys;
}

namespace {

/// Why output.settle has no effect.
std::string settles_nothing(const Scene& scene) {
  if (!scene.flag("output.settle")) return {};
  if (scene.has("integrator.step")) return "steps are fixed (integrator.step)";
  const std::string& name = scene.text("integrator.name");
  return Integrators::find(name, "integrator").settles ? "" : name + " does not settle pressures";
}

}  // namespace

std::vector<Key> key_table(const std::string& problem) {
  std::vector<Key> table = run_keys();
  for (Key& key : table) {
    if (key.name == "problem") key.choices = {problem};
    if (key.name == "output.settle") key.idle = settles_nothing;
  }
  add_registered<Integrator>(table, "integrator.name");
  const std::vector<Key> own = own_keys(Problems::find(problem, "problem"));
  table.insert(table.end(), own.begin(), own.end());
  return table;
}

}  // namespace gnomon
