#include "app/setup.hpp"

#include <gnomon/run.hpp>
#include <gnomon/versions.hpp>
#include <utility>

namespace gnomon::app {

Scene checked_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = load_scene(file, overrides, key_table);
  store_policy(scene);  // for their checks
  chosen_integrator(scene);
  return scene;
}

Setup set_up(Scene scene) {
  Setup setup{std::move(scene), nullptr};
  setup.model = Problems::find(setup.scene.text("problem"), "problem").make(setup.scene);
  return setup;
}

Setup set_up(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return set_up(checked_scene(file, overrides));
}

RunHeader run_header(const Setup& setup) {
  return {.problem = setup.scene.text("problem"),
          .integrator = setup.scene.text("integrator.name"),
          .scene = setup.scene.resolved(),
          .versions = library_versions(),
          .blocks = setup.model->blocks()};
}

}  // namespace gnomon::app
