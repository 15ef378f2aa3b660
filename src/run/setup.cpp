#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/shapes/profile.hpp>
#include <gnomon/system/system.hpp>
#include <utility>

namespace gnomon {

namespace {

/// In a scene with mistakes required keys may have no value.
void find_mistakes_of_run(const Scene& scene, Mistakes& mistakes) {
  if (scene.has("time.end")) mistakes.collect([&] { store_policy(scene); });
  if (scene.has("integrator.name")) mistakes.collect([&] { chosen_integrator(scene); });
  const std::string key = "wear.coefficient";
  const auto refuses_it = [&](const std::string& line) {
    return scene.knows(key) && line.starts_with(scene.where(key) + ": expected");
  };
  if (std::ranges::none_of(mistakes.lines(), refuses_it))  // else it is given, not missing
    mistakes.collect([&] { require_coefficient(scene); });
}

/// A result or a mesh instead of a scene is no bad TOML.
void require_scene_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (is_result(file))
    throw InputError(
        fmt::format("{0}: is a result, expected a scene (TOML); gnomon info {0} shows it, gnomon "
                    "resume {0} continues it, gnomon scene {0} prints its scene",
                    name));
  if (!std::filesystem::is_regular_file(file)) return;
  if (file.extension() == ".msh" || is_geometry(file))
    throw InputError(
        fmt::format("{0}: is a mesh or geometry, expected a scene (TOML); gnomon new "
                    "{0} makes one for it",
                    name));
}

}  // namespace

void check_run(const Scene& scene) {
  Mistakes mistakes;
  find_mistakes_of_run(scene, mistakes);
  mistakes.require_none();
}

namespace {

/// The scene if it has no mistakes; `load` adds those that it finds. A part may still get its mesh.
Scene without_mistakes(const std::function<Scene(Mistakes&)>& load, bool may_get_mesh) {
  Mistakes mistakes;
  Scene scene = load(mistakes);
  find_mistakes_of_run(scene, mistakes);
  const bool has_mesh = !may_get_mesh || !scene.knows("mesh.file") || scene.has("mesh.file");
  if (!mistakes.empty() && has_mesh) find_further_mistakes(scene, mistakes);
  mistakes.require_none();
  return scene;
}

}  // namespace

Scene checked_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                    const std::string& source) {
  require_scene_file(file);
  return without_mistakes(
      [&](Mistakes& mistakes) { return load_scene(file, overrides, key_table, &mistakes, source); },
      false);
}

Scene checked_scene_of_text(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides, const std::string& source) {
  return without_mistakes(
      [&](Mistakes& mistakes) {
        return parse_scene(text, name, overrides, key_table, &mistakes, source);
      },
      true);
}

namespace {

/// With the choices that follow from the size of the model, for the resolved scene.
Setup completed(const Scene& scene, std::unique_ptr<Model> model) {
  Scene complete = scene;
  for (const auto& [key, value] : model->system().structure().solver.keys)
    complete = complete.with(key, value);
  if (chooses_phases(scene)) complete = with_phases(complete, model->phases);
  if (scene.knows("counter_body.points")) complete = with_profile_points(complete);
  return {.scene = with_cycle_tables(complete), .model = std::move(model)};
}

}  // namespace

Setup set_up(const Scene& scene) {
  if (scene.has("accuracy.within"))
    throw InputError(scene.where("accuracy.within") +
                     ": expected none here, only gnomon run, plan and check choose settings");
  auto model = make_model(scene);
  return completed(scene.with_absolute_files(), std::move(model));
}

Scene scene_of_result(const ResultReader& result, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides, const std::string& to_load) {
  const auto read = [&](const std::vector<std::string>& changes) {
    return parse_scene(result.header().scene, file.string(), changes, key_table);
  };
  const Scene scene = [&] {
    try {
      return read({});
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}; if the run had a plug-in, {}", error.what(), to_load));
    }
  }();
  return overrides.empty() ? scene : read(overrides);
}

Setup set_up_again(const Scene& scene, const std::optional<Grid>& grid, double model_end) {
  Setup setup = completed(
      scene, remake_model(model_end > 0 ? scene.with("time.end", model_end) : scene, grid));
  setup.model_end = model_end;
  return setup;
}

Setup set_up(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return set_up(checked_scene(file, overrides));
}

std::vector<std::string> remarks_on_keys(const Setup& setup) {
  const Scene& scene = setup.scene;
  integrator_settings(scene, *setup.model);  // reads what a run reads
  scene.flag("output.budget");               // as does its end
  std::vector<std::string> remarks = scene.idle_texts();
  if (const std::string dropped = dropped_times_text(scene); !dropped.empty())
    remarks.push_back(dropped);
  for (const std::string& name : unused_wear_names(scene))
    remarks.push_back(
        name + " is given, but " +
        (name.starts_with("tables.") ? "no expression uses it" : "wear.rate does not use it"));
  for (const std::string& key : scene.unread_keys())
    remarks.push_back(key + " has no effect: nothing in this scene reads it");
  return remarks;
}

RunHeader run_header(const Setup& setup) {
  return {.problem = setup.scene.text("problem"),
          .integrator = setup.scene.text("integrator.name"),
          .scene = setup.scene.resolved(),
          .versions = library_versions(),
          .blocks = setup.model->blocks,
          .model_end = setup.model_end};
}

}  // namespace gnomon
