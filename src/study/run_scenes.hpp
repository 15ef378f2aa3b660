// The scenes of the runs of a study: its scene file, with other values in the place of its own.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"
#include "scene/scene_file.hpp"
#include "study/methods.hpp"

namespace gnomon::study {

/// By scene key.
using SceneValues = std::map<std::string, RawValue>;

/// As texts "KEY=VALUE".
std::vector<std::string> override_texts(const SceneValues& values);

/// Later ones in the place of earlier ones: those of the sweep point, what the method sets, and
/// what the study needs (integrator, its step or tolerance, times to store).
SceneValues values_of_run(SceneValues of_point, const Method& method, const StudySetting& setting,
                          const std::vector<double>& times);

class RunScenes {
public:
  explicit RunScenes(const std::filesystem::path& scene) : file_(scene) {}

  // These throw InputError.
  Scene with(const SceneValues& values) const;
  /// For folders of runs, to which files of the scene are not relative.
  Scene complete(const SceneValues& values) const;
  /// Of a run with a step or a tolerance. `compared`: its errors are measured.
  Scene of_run(const SceneValues& values, StudySetting::Kind kind, bool compared) const;

private:
  SceneFile file_;
};

}  // namespace gnomon::study
