#include <fmt/format.h>

#include <algorithm>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/laws/catalogue.hpp>
#include <gnomon/model/added_term.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/model/worn_body_scene.hpp>
#include <gnomon/terms/material_law.hpp>

namespace gnomon {

double estimated_memory(const Scene& scene) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (!problem.mesh_size) return 0;
  const MeshSize mesh = problem.mesh_size(scene);
  return estimated_memory(mesh, linear_solver_of(scene, mesh));
}

void require_memory(const Scene& scene, const MeshSize& mesh) {
  const double needed = estimated_memory(mesh, linear_solver_of(scene, mesh)),
               available = available_memory();
  if (needed > available)
    throw InputError(fmt::format(
        "{}: its mesh needs about {} of memory, {} are available; expected a coarser mesh",
        scene.path().string(), memory_text(needed), memory_text(available)));
}

std::unique_ptr<Model> make_model(const Scene& scene) {
  const Problem& problem = Problems::find(scene.text("problem"), "problem");
  if (problem.mesh_size) require_memory(scene, problem.mesh_size(scene));
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

bool has_key(const std::vector<Key>& table, const std::string& name) {
  return std::any_of(table.begin(), table.end(), [&](const Key& key) { return key.name == name; });
}

/// Adds the keys of the registered laws to a table with `wear.law`.
void add_wear_laws(std::vector<Key>& table) {
  const auto law = std::find_if(table.begin(), table.end(),
                                [](const Key& key) { return key.name == "wear.law"; });
  if (law == table.end()) return;
  law->choices = Registry<WearLawKind>::names();
  for (const WearLawKind& kind : Registry<WearLawKind>::all())
    for (const Key& key : kind.keys)
      if (!has_key(table, key.name)) table.push_back(key);
}

}  // namespace

std::vector<Key> own_keys(const Problem& problem) {
  std::vector<Key> keys = problem.keys;
  if (problem.registered_keys) {
    const std::vector<Key> more = problem.registered_keys();
    keys.insert(keys.end(), more.begin(), more.end());
  }
  for (const char* material : {"body.material", "shape.energy"}) add_material_keys(keys, material);
  add_wear_laws(keys);
  if (has_key(keys, "body.young_modulus"))
    for (const AddedTerm& term : AddedTerms::all())
      keys.insert(keys.end(), term.keys.begin(), term.keys.end());
  return keys;
}

std::vector<Key> key_table(const std::string& problem) {
  std::vector<Key> table = run_keys();
  for (Key& key : table) {
    if (key.name == "problem") key.choices = {problem};
    if (key.name == "integrator.name") key.choices = Integrators::names();
  }
  const std::vector<Key> own = own_keys(Problems::find(problem, "problem"));
  table.insert(table.end(), own.begin(), own.end());
  return table;
}

}  // namespace gnomon
