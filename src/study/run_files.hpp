// The files of one run in FOLDER/runs, and whether they belong to a finished run.
#pragma once

#include <filesystem>
#include <gnomon/base/counters.hpp>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/process_pool.hpp"

namespace gnomon::study {

struct RunFiles {
  RunFiles(const std::filesystem::path& folder, const std::string& name);

  std::filesystem::path scene;    ///< NAME.toml, the resolved scene
  std::filesystem::path result;   ///< NAME.h5
  std::filesystem::path sidecar;  ///< NAME.xdmf
  std::filesystem::path summary;  ///< NAME.json
  std::filesystem::path process;  ///< NAME.process.json: results of wait4, and of which scene
  std::filesystem::path log;      ///< NAME.log: its standard error
};

/// The data of a run that has ended.
struct RunRecord {
  bool complete = false;  ///< the run ended by itself and wrote its summary
  std::string status;     ///< "finished", "failed"
  std::string reason;
  std::optional<Counters> counters;
  std::optional<double> wall_seconds;
  std::optional<double> reached;  ///< time of the last good state
  std::optional<ProcessEnd> end;
};

void remove_files(const RunFiles& files);
/// Notes how the process of a run ended.
void write_process_end(const RunFiles& files, const StudyRun& run, const ProcessEnd& end);
/// The record of exactly this run by exactly this version of gnomon, if there is one.
std::optional<RunRecord> read_record(const RunFiles& files, const StudyRun& run);

/// The contact surface of a result at these times. Throws InputError when one cannot be read.
std::vector<ContactSurface> read_surfaces(const RunFiles& files, const std::vector<double>& times);

}  // namespace gnomon::study
