// The methods of a study, and the references that their errors are measured by: the tables
// [[method]] and [[reference]].
#pragma once

#include <gnomon/scene/scene.hpp>
#include <gnomon/study/study.hpp>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"
#include "study/keyed_table.hpp"

namespace gnomon::study {

/// A [[method]] or [[reference]].
struct Method {
  std::string name;
  std::string integrator;
  std::vector<StudySetting> ladder;
  std::vector<SceneSetting> settings;
  std::string origin;  ///< beginning of a message about it
};

/// "step", "rtol".
std::string kind_name(StudySetting::Kind kind);
/// Shortest text of a number: 20 for 20.0.
std::string number_text(double value);

/// Adds that of a [[method]] to `methods`. Throws InputError.
void add_method(const std::string& file, const RawTable& table, const SceneKeys& scene_keys,
                std::vector<Method>& methods);
/// A parameter sweep needs no method: the scene has one.
Method method_of_scene(const Scene& scene);

/// That of a [[reference]]. Throws InputError.
Method read_reference(const std::string& file, const RawTable& table, SceneKeys scene_keys);
/// Those of a study that names none.
std::vector<Method> default_references(const std::string& file);
/// Throws InputError unless there are two, of two families.
void require_two_families(const std::vector<Method>& references);

}  // namespace gnomon::study
