#include "study/run_files.hpp"

#include <fmt/format.h>
#include <string.h>

#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/study/versions.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon::study {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// An empty value for a file that is missing or truncated.
Json read_json(const fs::path& file) {
  Json json = Json::parse(read_text(file), nullptr, false);
  return json.is_object() ? json : Json();
}

Counters counters_of(const Json& json) {
  const auto get = [&](const char* name) { return json.value(name, 0L); };
  return {.steps = get("steps"),
          .rejected_steps = get("rejected_steps"),
          .events = get("events"),
          .newton_iterations = get("newton_iterations"),
          .residual_evaluations = get("residual_evaluations"),
          .jacobian_evaluations = get("jacobian_evaluations"),
          .factorizations = get("factorizations"),
          .linear_solves = get("linear_solves"),
          .krylov_iterations = get("krylov_iterations"),
          .preconditioner_setups = get("preconditioner_setups")};
}

/// Why a process that wrote no summary has failed: the last line of its messages.
std::string reason_of(const RunFiles& files, const Json& process) {
  if (process.value("timed_out", false)) return "took longer than allowed";
  if (const int signal = process.value("signal", 0); signal != 0)
    return fmt::format("ended by signal {} ({})", signal, strsignal(signal));
  std::string line, last;
  for (std::istringstream log(read_text(files.log)); std::getline(log, line);)
    if (!line.empty()) last = line;
  if (last.starts_with("gnomon: ")) last.erase(0, 8);
  return last.empty() ? fmt::format("ended with exit code {}", process.value("exit_code", -1))
                      : last;
}

void read_summary(RunRecord& record, const Json& summary) {
  record.status = summary.value("status", "");
  record.complete = record.status == "finished" || record.status == "failed";
  record.reason = summary.value("diagnosis", "");
  record.counters = counters_of(summary);
  record.wall_seconds = summary.value("wall_seconds", 0.0);
  if (const auto t = summary.find("t"); t != summary.end() && t->is_number())
    record.reached = t->get<double>();
}

}  // namespace

RunFiles::RunFiles(const fs::path& folder, const std::string& name)
    : scene(folder / "runs" / (name + ".toml")),
      result(folder / "runs" / (name + ".h5")),
      sidecar(folder / "runs" / (name + ".xdmf")),
      summary(folder / "runs" / (name + ".json")),
      process(folder / "runs" / (name + ".process.json")),
      log(folder / "runs" / (name + ".log")) {}

void remove_files(const RunFiles& files) {
  std::error_code
      ignored;  // a file that cannot be removed cannot be written either, and that is reported
  for (const fs::path* file :
       {&files.process, &files.summary, &files.result, &files.sidecar, &files.log})
    fs::remove(*file, ignored);
}

void write_process_end(const RunFiles& files, const StudyRun& run, const ProcessEnd& end) {
  nlohmann::ordered_json json;
  json["exit_code"] = end.exit_code;
  json["signal"] = end.signal;
  json["timed_out"] = end.timed_out;
  json["cpu_seconds"] = end.cpu_seconds;
  json["peak_memory_mb"] = end.peak_memory_mb;
  json["versions"] = library_versions();
  json["scene"] = run.scene.resolved();
  json["overrides"] = run.overrides;
  write_file(files.process, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
             Earlier::replaced);
}

std::optional<RunRecord> read_record(const RunFiles& files, const StudyRun& run) try {
  const Json process = read_json(files.process);
  if (process.value("scene", "") != run.scene.resolved() ||
      process.value("overrides", Json::array()) != Json(run.overrides) ||
      process.value("versions", Json()) != Json(library_versions()))
    return std::nullopt;
  RunRecord record;
  if (const Json summary = read_json(files.summary); !summary.is_null())
    read_summary(record, summary);
  if (!record.complete) {
    record.status = "failed";
    record.reason = reason_of(files, process);
  }
  record.end = ProcessEnd{.exit_code = process.value("exit_code", -1),
                          .signal = process.value("signal", 0),
                          .timed_out = process.value("timed_out", false),
                          .cpu_seconds = process.value("cpu_seconds", 0.0),
                          .peak_memory_mb = process.value("peak_memory_mb", 0.0)};
  return record;
} catch (const Json::exception&) {
  return std::nullopt;  // a damaged record counts as none
}

std::vector<ContactSurface> read_surfaces(const RunFiles& files, const std::vector<double>& times) {
  const ResultReader result(files.result);
  std::vector<ContactSurface> surfaces;
  for (const double t : times) surfaces.push_back(result.contact(t));
  return surfaces;
}

}  // namespace gnomon::study
