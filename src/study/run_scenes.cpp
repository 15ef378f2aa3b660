#include "study/run_scenes.hpp"

#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/run/run.hpp>
#include <utility>

#include "scene/key_check.hpp"
#include "scene/toml_text.hpp"

namespace gnomon::study {

std::vector<std::string> override_texts(const SceneValues& values) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : values) texts.push_back(key + "=" + toml_text(value));
  return texts;
}

SceneValues values_of_run(SceneValues of_point, const Method& method, const StudySetting& setting,
                          const std::vector<double>& times) {
  SceneValues values = std::move(of_point);
  for (const SceneSetting& own : method.settings) values[own.key] = own.value;
  values["integrator.name"] = raw_value(method.integrator);
  const bool fixed = setting.kind == StudySetting::Kind::step;
  values[fixed ? "integrator.step" : "integrator.rtol"] = raw_value(setting.value);
  values["output.every"] = raw_value(0L);
  values["output.times"] = raw_value(times);
  return values;
}

Scene RunScenes::with(const SceneValues& values) const {
  std::vector<GivenValue> overrides;
  for (const auto& [key, value] : values) overrides.push_back(override_of(key, value));
  return file_.scene(overrides, key_table);
}

Scene RunScenes::complete(const SceneValues& values) const {
  return with_cycle_tables(with(values)).with_absolute_files();
}

Scene RunScenes::of_run(const SceneValues& values, StudySetting::Kind kind, bool compared) const {
  Scene scene = complete(values);
  if (kind != StudySetting::Kind::step) scene = scene.without("integrator.step");
  if (scene.has("accuracy.within"))
    throw InputError(scene.where("accuracy.within") +
                     ": expected none in a study, which has settings of its own");
  if (compared && scene.given("time.until"))
    throw InputError(scene.where("time.until") +
                     ": expected none in a study of errors, whose runs end at the same time");
  // Costs are compared: an estimate beside the run is not one of the method.
  scene = scene.with("output.budget", false);
  if (scene.knows("cycle.period") && scene.has("cycle.period"))
    scene = scene.with("output.phase_errors", false);
  store_policy(scene);
  chosen_integrator(scene);
  return scene;
}

}  // namespace gnomon::study
