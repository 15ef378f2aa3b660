#include "study/run_files.hpp"

#include <fmt/format.h>
#include <string.h>

#include <gnomon/base/counter_names.hpp>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/results/versions.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/text_file.hpp"

namespace gnomon::study {

namespace fs = std::filesystem;

namespace {

Counters counters_of(const Json& json) {
  Counters counters;
  for (const NamedCounter& counter : named_counters)
    counters.*counter.value = json.value(counter.name, 0L);
  return counters;
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
  record.warnings = summary.value("warnings", std::vector<std::string>{});
  record.counters = counters_of(summary);
  record.wall_seconds = summary.value("wall_seconds", 0.0);
  if (const auto t = summary.find("t"); t != summary.end() && t->is_number())
    record.reached = t->get<double>();
}

}  // namespace

RunFiles::RunFiles(const fs::path& folder, const std::string& name)
    : scene(folder / (name + ".toml")),
      result(folder / (name + ".h5")),
      sidecar(folder / (name + ".xdmf")),
      summary(folder / (name + ".json")),
      process(folder / (name + ".process.json")),
      log(folder / (name + ".log")) {}

void write_process_end(const RunFiles& files, const StudyRun& run, const ProcessEnd& end) {
  nlohmann::ordered_json json;
  json["exit_code"] = end.exit_code;
  json["signal"] = end.signal;
  json["timed_out"] = end.timed_out;
  json["cpu_seconds"] = end.cpu_seconds;
  json["peak_memory_mb"] = end.peak_memory_mb;
  json["versions"] = library_versions();
  json["scene"] = run.scene;
  json["overrides"] = run.overrides;
  write_file(files.process, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
             Earlier::replaced);
}

std::optional<RunRecord> read_record(const RunFiles& files, const StudyRun& run) try {
  const Json process = read_json(files.process);
  if (process.value("scene", "") != run.scene ||
      process.value("overrides", Json::array()) != Json(run.overrides) ||
      process.value("versions", Json()) != Json(library_versions()))
    return std::nullopt;
  RunRecord record;
  if (const Json summary = read_json(files.summary); !summary.empty())
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

bool is_interrupted(const RunFiles& files) {
  const Json summary = read_json(files.summary);
  return summary.value("status", "") == "interrupted";
}

double checkpointed_time(const RunFiles& files) try {
  const ResultReader result(files.result);
  const std::vector<Checkpoint> checkpoints = result.checkpoints();
  const std::vector<HistoryRow> history = result.history();
  const auto rows = checkpoints.empty() ? 0 : static_cast<std::size_t>(checkpoints.back().rows);
  return rows > 0 && rows <= history.size() ? history[rows - 1].t : 0;
} catch (const InputError&) {
  return 0;
}

bool copy_at_rest(const fs::path& from, const fs::path& to) {
  std::error_code error, ignored;
  const auto written = fs::last_write_time(from, error);
  if (!error) fs::copy_file(from, to, error);
  if (!error && fs::last_write_time(from, error) == written && !error) return true;
  fs::remove(to, ignored);
  return false;
}

void remove_result(const RunFiles& files) {
  std::error_code ignored;
  fs::remove(files.result, ignored);
  fs::remove(files.sidecar, ignored);
}

std::vector<Scalar> read_observed(const RunFiles& files) {
  const std::vector<HistoryRow> history = ResultReader(files.result).history();
  if (history.empty()) throw InputError(fmt::format("{}: it holds no step", files.result.string()));
  std::vector<Scalar> columns = history.back().scalars;
  if (const std::optional<double> difference = wear_difference(columns))
    columns.push_back(common("wear_difference", *difference, dimension_of(columns)));
  return columns;
}

std::vector<ContactSurface> read_surfaces(const RunFiles& files, const std::vector<double>& times) {
  const ResultReader result(files.result);
  std::vector<ContactSurface> surfaces;
  for (const double t : times) surfaces.push_back(result.contact(t));
  return surfaces;
}

}  // namespace gnomon::study
