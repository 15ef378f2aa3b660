#include "app/setup.hpp"

#include <gnomon/run.hpp>
#include <gnomon/versions.hpp>

namespace gnomon::app {

Setup set_up(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Setup setup;
  setup.scene = load_scene(file, overrides, key_table);
  store_policy(setup.scene);  // for their checks; a model may take long to make
  chosen_integrator(setup.scene);
  setup.model = Problems::find(setup.scene.text("problem"), "problem").make(setup.scene);
  return setup;
}

RunHeader run_header(const Setup& setup) {
  return {.problem = setup.scene.text("problem"),
          .integrator = setup.scene.text("integrator.name"),
          .scene = setup.scene.resolved(),
          .versions = library_versions(),
          .blocks = setup.model->blocks()};
}

}  // namespace gnomon::app
