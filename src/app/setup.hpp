// From a scene file to the things that a command works with.
#pragma once

#include <filesystem>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::app {

struct Setup {
  Scene scene;
  std::unique_ptr<Model> model;
};

/// Checks of several keys that take no model. Throws InputError.
void check_run(const Scene& scene);

/// Loads the scene and checks it whole, as far as that takes no model.
Scene checked_scene(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// The model of a checked scene, which may take long to make.
Setup set_up(Scene scene);
/// Both.
Setup set_up(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// What the result file and the summary say about the run of a set-up.
RunHeader run_header(const Setup& setup);

}  // namespace gnomon::app
