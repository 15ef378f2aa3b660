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
  double model_end = 0;  ///< RunHeader::model_end
};

/// Checks of combinations of keys that do not need a model. Throws InputError.
void check_run(const Scene& scene);

/// Loads the scene (load_scene()) and makes all checks that do not need a model.
Scene checked_scene(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                    const std::string& source = "--set ");

/// The same from TOML text; `name` stands for the file in messages, and files that the scene names
/// are relative to its folder.
Scene checked_scene_of_text(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides,
                            const std::string& source = "--set ");

/// How a program that has the options of gnomon gets a plug-in, for messages.
inline constexpr const char* plugin_option =
    "load it by --plugin FILE.so before the command, or by GNOMON_PLUGINS=FILE.so";

/// The scene of a result. Where this gnomon does not know what the scene names, the message of the
/// InputError says how a plug-in is loaded (`to_load`), which the run may have had.
Scene scene_of_result(const ResultReader& result, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides = {},
                      const std::string& to_load = plugin_option);

/// Makes the model of a checked scene, which may take long. Files that the scene names are absolute
/// paths from there on.
Setup set_up(const Scene& scene);
/// The same from the mesh that a result keeps, with the model of this time.end (0: the scene's):
/// how far contact reaches depends on it.
Setup set_up_again(const Scene& scene, const std::optional<Grid>& grid, double model_end = 0);
/// Both.
Setup set_up(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// What the user should know of the scene besides the model's remarks, one line each: output times
/// that are not reached, keys without an effect.
std::vector<std::string> remarks_on_keys(const Setup& setup);

/// The description of the run that the result file and the summary contain.
RunHeader run_header(const Setup& setup);

}  // namespace gnomon
