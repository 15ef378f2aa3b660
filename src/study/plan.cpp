#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/result_files.hpp>
#include <nlohmann/json.hpp>

#include "study/declaration.hpp"
#include "study/run_files.hpp"
#include "study/study_folder.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace {

namespace fs = std::filesystem;
using study::Json;

constexpr const char* plan_file = "plan.json";
constexpr const char* list_file = "plan.csv";
constexpr const char* text_file = "study.toml";

using study::text_of;

Json json_of(const SweepPoint& point) {
  Json json;
  json["label"] = point.label;
  json["values"] = point.values;
  json["times"] = point.times;
  json["references"] = point.references;
  json["closed_form"] = point.has_closed_form();
  if (point.self_reference) json["self_reference"] = *point.self_reference;
  return json;
}

Json json_of(const StudyPoint& point) {
  return {{"sweep", point.sweep},
          {"run", point.run},
          {"method", point.method},
          {"integrator", point.integrator},
          {"setting_kind", study::kind_name(point.setting.kind)},
          {"setting", point.setting.value}};
}

Json json_of(const StudyRun& run) {
  return {{"name", run.name}, {"title", run.title}, {"overrides", run.overrides}};
}

template <class T>
Json array_of(const std::vector<T>& values) {
  Json array = Json::array();
  for (const T& value : values) array.push_back(json_of(value));
  return array;
}

SweepPoint sweep_point(const Json& json) {
  SweepPoint point;
  point.label = json.at("label");
  point.values = json.at("values");
  point.times = json.at("times").get<std::vector<double>>();
  point.references = json.at("references").get<std::vector<std::size_t>>();
  if (const auto self = json.find("self_reference"); self != json.end())
    point.self_reference = self->get<std::size_t>();
  return point;
}

StudyPoint study_point(const Json& json) {
  const bool step = json.at("setting_kind") == study::kind_name(StudySetting::Kind::step);
  return {json.at("sweep"),
          json.at("run"),
          json.at("method"),
          json.at("integrator"),
          {step ? StudySetting::Kind::step : StudySetting::Kind::tolerance, json.at("setting")},
          {}};
}

std::string list_of(const Study& study) {
  std::string text = "number,run\n";
  for (std::size_t i = 0; i < study.runs.size(); ++i)
    text += fmt::format("{},{}\n", i + 1, study.runs[i].name);
  return text;
}

Study study_of(const Json& json, const fs::path& folder) {
  Study study;
  study.name = json.at("study");
  study.title = json.at("title");
  study.file = json.at("file").get<std::string>();
  study.scene = json.at("scene").get<std::string>();
  study.text = text_of(folder / text_file);
  study.self_reference = json.at("self_reference");
  study.compared = json.at("compared");
  study.units = json.value("units", study.units);  // plans of earlier versions have none
  for (const Json& point : json.at("sweep")) study.sweep.push_back(sweep_point(point));
  for (const Json& point : json.at("points")) study.points.push_back(study_point(point));
  for (const Json& run : json.at("runs"))
    study.runs.push_back({run.at("name"), run.at("title"), {}, run.at("overrides")});
  return study;
}

/// Numbers in a plan that somebody has edited.
void require_consistent(const Study& study) {
  const auto require_run = [&](std::size_t run) {
    if (run >= study.runs.size()) throw InputError("it names a run that it does not have");
  };
  if (study.sweep.empty()) throw InputError("it has no sweep point");
  for (const SweepPoint& point : study.sweep)
    for (const std::size_t run : point.references) require_run(run);
  for (const StudyPoint& point : study.points) {
    require_run(point.run);
    if (point.sweep >= study.sweep.size())
      throw InputError("it names a sweep point that it does not have");
  }
}

/// Closed forms are computed anew, from the scene of any run of their sweep point.
void add_closed_forms(Study& study, const Json& sweep) {
  for (std::size_t i = 0; i < study.sweep.size(); ++i) {
    if (!sweep.at(i).at("closed_form").get<bool>()) continue;
    const auto point = std::ranges::find(study.points, i, &StudyPoint::sweep);
    if (point == study.points.end()) continue;
    const StudyRun& run = study.runs[point->run];
    const auto model = make_model(parse_scene(run.scene, run.name, {}, key_table));
    study.sweep[i].exact = study::closed_form(*model, study.sweep[i].times);
  }
}

void require_planned(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / plan_file, ignored))
    throw InputError(
        fmt::format("{}: expected the folder of a study, made by gnomon study plan, "
                    "there is no {}",
                    folder.string(), plan_file));
}

Study checked_plan(const fs::path& folder, const Json& json) {
  Study study = study_of(json, folder);
  require_consistent(study);
  return study;
}

}  // namespace

namespace study {

void write_plan(const fs::path& folder, const Study& study) {
  // Scenes that have not changed keep their files: other processes may be reading them.
  for (const StudyRun& run : study.runs)
    if (const fs::path file = files_of_run(folder, run.name).scene;
        !fs::exists(file) || read_text(file) != run.scene)
      write_file(file, run.scene, Earlier::replaced);
  Json json;
  json["study"] = study.name;
  json["title"] = study.title;
  json["file"] = study.file.string();
  json["scene"] = study.scene.string();
  json["self_reference"] = study.self_reference;
  json["compared"] = study.compared;
  json["units"] = study.units;
  json["sweep"] = array_of(study.sweep);
  json["points"] = array_of(study.points);
  json["runs"] = array_of(study.runs);
  const auto replace = Json::error_handler_t::replace;
  write_file(folder / list_file, list_of(study), Earlier::replaced);
  write_file(folder / plan_file, json.dump(1, ' ', false, replace) + "\n", Earlier::replaced);
}

std::string planned_scene(const fs::path& folder, const std::string& run) {
  return text_of(files_of_run(folder, run).scene);
}

}  // namespace study

Study read_plan(const fs::path& folder) {
  require_planned(folder);
  try {
    return checked_plan(folder, Json::parse(text_of(folder / plan_file)));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is damaged, plan the study again: {}",
                                 (folder / plan_file).string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", (folder / plan_file).string(), error.what()));
  }
}

Study read_whole_plan(const fs::path& folder) {
  Study study = read_plan(folder);
  for (StudyRun& run : study.runs) run.scene = study::planned_scene(folder, run.name);
  add_closed_forms(study, Json::parse(text_of(folder / plan_file)).at("sweep"));
  return study;
}

}  // namespace gnomon
