// The files of one run in FOLDER/runs, or in the folder of an attempt at it, and whether they
// belong to a finished run.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::study {

struct RunFiles {
  /// The files in this very folder.
  RunFiles(const std::filesystem::path& folder, const std::string& name);

  std::filesystem::path scene;    ///< NAME.toml, the resolved scene
  std::filesystem::path result;   ///< NAME.h5
  std::filesystem::path sidecar;  ///< NAME.xdmf
  std::filesystem::path summary;  ///< NAME.json
  std::filesystem::path process;  ///< NAME.process.json: results of wait4, and of which scene
  std::filesystem::path log;      ///< NAME.log: its standard error
};

/// Those of a run that is done, or planned, in the folder of its study.
inline RunFiles files_of_run(const std::filesystem::path& study, const std::string& name) {
  return {study / "runs", name};
}

/// Notes how the process of a run ended.
void write_process_end(const RunFiles& files, const StudyRun& run, const ProcessEnd& end);
/// The record of exactly this run by exactly this version of gnomon, if there is one.
std::optional<RunRecord> read_record(const RunFiles& files, const StudyRun& run);

/// Whether the run ended because it was asked to, with a summary that says so.
bool is_interrupted(const RunFiles& files);
/// The time from which the result can be continued; 0 without a checkpoint.
double checkpointed_time(const RunFiles& files);
/// Copies a file that a lost process might still write. False, and there is no copy, if it did so
/// in the meantime, or the file cannot be copied.
bool copy_at_rest(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes the result and its sidecar.
void remove_result(const RunFiles& files);

/// What a result observed at its end, and how far the worn volume is from the integral of the wear
/// (wear_difference). Throws InputError when it cannot be read.
std::vector<Scalar> read_observed(const RunFiles& files);
/// The contact surface of a result at these times. Throws InputError when one cannot be read.
std::vector<ContactSurface> read_surfaces(const RunFiles& files, const std::vector<double>& times);

/// Of numbers of runs of a plan, from 1, as text, "3", "3-7", "3,5,9-12": the indices (from 0) of
/// the runs, each once, in their order. Throws InputError for anything but numbers up to `count`.
std::vector<std::size_t> runs_numbered(const std::string& text, std::size_t count);

/// The shortest text of these indices, ascending.
std::string numbers_of(std::vector<std::size_t> runs);

}  // namespace gnomon::study
