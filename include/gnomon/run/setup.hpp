// From a scene file to the objects that a command works with.
#pragma once

#include <filesystem>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

struct Setup {
  Scene scene;
  std::unique_ptr<Model> model;
};

/// Checks of combinations of keys that do not need a model. Throws InputError.
void check_run(const Scene& scene);

/// Loads the scene and makes all checks that do not need a model.
Scene checked_scene(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// The same from TOML text; `name` stands for the file in messages, and files that the scene names
/// are relative to its folder.
Scene checked_scene_of_text(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides);

/// Makes the model of a checked scene, which may take long.
Setup set_up(Scene scene);
/// The same from the mesh that a result keeps.
Setup set_up_again(Scene scene, const std::optional<Grid>& grid);
/// Both.
Setup set_up(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// The description of the run that the result file and the summary contain.
RunHeader run_header(const Setup& setup);

}  // namespace gnomon
