#include "study/study_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/result_files.hpp>
#include <nlohmann/json.hpp>

#include "study/declaration.hpp"
#include "study/run_files.hpp"
#include "study/table.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace study {

namespace {

namespace fs = std::filesystem;

constexpr const char* plan_file = "plan.json";
constexpr const char* list_file = "plan.csv";
constexpr const char* marker = "study.toml";  // its presence shows that a folder is that of a study
constexpr const char* name_file = "study.name";  // holds the name of the study

void write_in_place(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const bool written = descriptor >= 0 && write(descriptor, text.data(), text.size()) ==
                                              static_cast<ssize_t>(text.size());
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written)
    throw InputError(fmt::format("cannot write {}: {}", file.string(), std::strerror(error)));
}

void check_folder(const fs::path& folder, bool resume) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw InputError(
        fmt::format("{}: is a file, expected a folder for the study's results", folder.string()));
  if (fs::is_empty(folder, error)) return;
  if (!holds_study(folder))
    throw InputError(fmt::format("{}: is not the folder of a study, expected one or a new name",
                                 folder.string()));
  if (!resume)
    throw InputError(fmt::format("{}: exists already, expected a new name, or --resume to continue",
                                 folder.string()));
}

void prepare_folder(const fs::path& folder, const std::string& text) {
  std::error_code error;
  fs::create_directories(folder / "runs", error);
  if (error)
    throw InputError(
        fmt::format("cannot make {}: {}", (folder / "runs").string(), error.message()));
  // Not replaced by renaming: the lock is on this very file.
  if (!holds_study(folder)) write_in_place(folder / marker, text);
}

/// Prevents that one study replaces the tables of another. A folder without a name is one whose
/// study stopped before it wrote its name.
void claim_folder(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name_file;
  std::string holder;
  if (std::ifstream stream(file); std::getline(stream, holder) && holder != name)
    throw InputError(fmt::format("{}: holds study \"{}\", expected \"{}\" or an empty folder",
                                 folder.string(), holder, name));
  if (holder.empty()) write_file(file, name + "\n", Earlier::replaced);
}

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
          {"setting_kind", kind_name(point.setting.kind)},
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
  const bool step = json.at("setting_kind") == kind_name(StudySetting::Kind::step);
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
  study.text = text_of(folder / marker);
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
    study.sweep[i].exact = closed_form(*model, study.sweep[i].times);
  }
}

void require_planned(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / plan_file, ignored))
    throw InputError(
        fmt::format("{}: expected the folder of a study, made by gnomon study plan, there is no {}",
                    folder.string(), plan_file));
}

/// Writes plan.json, the numbered list plan.csv, and the scene of every run, for processes that do
/// runs without the study file.
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
  write_file(folder / list_file, list_of(study), Earlier::replaced);
  write_file(folder / plan_file, json_text(json), Earlier::replaced);
}

}  // namespace

/// Opened for writing, which network file systems require of a lock for one alone. On one without
/// locks there is none: the claims of single runs suffice for correct results.
FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(open((folder / marker).c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (descriptor_ >= 0 && error != EWOULDBLOCK) return;
  if (descriptor_ >= 0) close(descriptor_);
  throw InputError(fmt::format(
      "{}: {}", folder.string(),
      error == EWOULDBLOCK ? "another study is running there, expected none" : strerror(error)));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FolderLock claimed_folder(const Study& study, const fs::path& folder, bool resume) {
  check_folder(folder, resume);
  prepare_folder(folder, study.text);
  FolderLock lock(folder);
  claim_folder(folder, study.name);
  write_in_place(folder / marker, study.text);
  write_plan(folder, study);
  return lock;
}

}  // namespace study

using namespace study;

bool holds_study(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / marker, ignored);
}

void plan_study(const Study& study, const std::filesystem::path& folder, bool resume) {
  claimed_folder(study, folder, resume);
}

Study read_plan(const std::filesystem::path& folder) {
  require_planned(folder);
  try {
    const Study study = study_of(Json::parse(text_of(folder / plan_file)), folder);
    require_consistent(study);
    return study;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is damaged, plan the study again: {}",
                                 (folder / plan_file).string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", (folder / plan_file).string(), error.what()));
  }
}

Study read_whole_plan(const std::filesystem::path& folder) {
  Study study = read_plan(folder);
  for (StudyRun& run : study.runs) run.scene = text_of(files_of_run(folder, run.name).scene);
  add_closed_forms(study, Json::parse(text_of(folder / plan_file)).at("sweep"));
  return study;
}

}  // namespace gnomon
