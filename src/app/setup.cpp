#include "app/setup.hpp"

#include <gnomon/laws/profile.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/study/versions.hpp>
#include <utility>

namespace gnomon::app {

void check_run(const Scene& scene) {
  store_policy(scene);  // for their checks
  chosen_integrator(scene);
}

Scene checked_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = load_scene(file, overrides, key_table);
  check_run(scene);
  return scene;
}

namespace {

/// The scene with the choices that follow from the size of the model, for the resolved scene.
Scene with_choices(const Scene& scene, const LinearSolverChoice& solver) {
  const bool block = solver.method == LinearSolverChoice::Method::block;
  if (scene.knows("solver.method") && !scene.has("solver.method"))
    return with_choices(scene.with("solver.method", block ? "block" : "direct"), solver);
  if (!block || scene.has("solver.preconditioner")) return scene;
  const bool factor = solver.preconditioner == LinearSolverChoice::Preconditioner::factor;
  return scene.with("solver.preconditioner", factor ? "factor" : "multigrid");
}

}  // namespace

namespace {

Setup completed(Scene scene, std::unique_ptr<Model> model) {
  Scene complete = with_choices(scene, model->system().structure().solver);
  if (scene.knows("counter_body.file")) complete = with_profile_points(complete);
  return {std::move(complete), std::move(model)};
}

}  // namespace

Setup set_up(Scene scene) {
  auto model = make_model(scene);
  return completed(std::move(scene), std::move(model));
}

Setup set_up_again(Scene scene, const std::optional<Grid>& grid) {
  auto model = remake_model(scene, grid);
  return completed(std::move(scene), std::move(model));
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
