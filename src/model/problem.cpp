#include <fmt/format.h>

#include <algorithm>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/model/solver_scene.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

namespace gnomon {

double estimated_memory(const Scene& scene) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (!problem.mesh_size) return 0;
  const MeshSize mesh = problem.mesh_size(scene);
  return estimated_memory(mesh, linear_solver_of(scene, mesh));
}

namespace {

/// In space, where the estimate by the keys is rough, only what is certainly too much is refused;
/// when the mesh exists, its memory is estimated again.
void require_memory_by_keys(const Scene& scene, const MeshSize& mesh) {
  const LinearSolverChoice solver = linear_solver_of(scene, mesh);
  if (mesh.dim == 3 && estimated_memory(mesh, solver) / 2 <= available_memory()) return;
  require_memory(scene, mesh, solver);
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

/// Adds the key of a law, which another law may have too: then with the same meaning of its
/// absence.
void add_law_key(std::vector<Key>& table, const Key& key, const std::string& law) {
  const auto same = std::find_if(table.begin(), table.end(),
                                 [&](const Key& other) { return other.name == key.name; });
  const auto chosen = [law](const Scene& scene) { return scene.text("wear.law") == law; };
  if (same == table.end()) {
    table.push_back(key);
    table.back().applies = chosen;
    return;
  }
  if (same->applies)  // of another law
    same->applies = [chosen, other = same->applies](const Scene& scene) {
      return other(scene) || chosen(scene);
    };
  if (same->kind != key.kind || same->presence != key.presence ||
      same->default_value != key.default_value)
    throw RegistrationError("the wear law " + law + " has the key " + key.name +
                            " with another kind or default than the key of this name that is "
                            "known, expected another name or the same");
}

/// Adds the keys of the registered laws to a table with `wear.law`.
void add_wear_laws(std::vector<Key>& table) {
  const auto law = std::find_if(table.begin(), table.end(),
                                [](const Key& key) { return key.name == "wear.law"; });
  if (law == table.end()) return;
  law->choices = Registry<WearLawKind>::names();
  for (const WearLawKind& kind : Registry<WearLawKind>::all())
    for (const Key& key : kind.keys) add_law_key(table, key, kind.name);
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
  add_wear_laws(keys);
  return keys;
}

namespace {

/// Whether the steps of the scene's integrator can settle pressures (output.settle).
bool can_settle(const Scene& scene) {
  return !scene.has("integrator.step") &&
         Integrators::find(scene.text("integrator.name"), "integrator").settles;
}

}  // namespace

std::vector<Key> key_table(const std::string& problem) {
  std::vector<Key> table = run_keys();
  for (Key& key : table) {
    if (key.name == "problem") key.choices = {problem};
    if (key.name == "integrator.name") key.choices = Integrators::names();
    if (key.name == "output.settle") key.applies = can_settle;
  }
  const std::vector<Key> own = own_keys(Problems::find(problem, "problem"));
  table.insert(table.end(), own.begin(), own.end());
  return table;
}

}  // namespace gnomon
