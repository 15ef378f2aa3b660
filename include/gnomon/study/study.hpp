// A study: many runs of one scene, with their errors against a reference and their costs.
// docs/studies.md describes the study file and the results.
#pragma once

#include <filesystem>
#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// The setting that determines the accuracy of a run.
struct StudySetting {
  enum class Kind { step, tolerance };
  Kind kind = Kind::step;
  double value = 0;  ///< integrator.step [time], or integrator.rtol
};

/// One process: a resolved scene to run.
struct StudyRun {
  std::string name;   ///< stem of its files in runs/
  std::string title;  ///< "bdf rtol 1e-09"
  std::string scene;  ///< its resolved text
  /// "key=value", given to the program in addition to the scene: values that no valid scene can
  /// contain (Impossible::kept).
  std::vector<std::string> overrides{};
};

/// One combination of the swept values.
struct SweepPoint {
  std::string label;  ///< "body.young_modulus=20"; empty without a sweep
  std::vector<std::pair<std::string, std::string>> values;  ///< keys and values: "20", "20x40"
  std::vector<double> times;            ///< at which errors are measured; the last: time.end
  std::vector<ContactSurface> exact;    ///< closed form at these times, if there is one
  std::vector<std::size_t> references;  ///< runs; empty with a closed form, or uncompared
  bool has_closed_form() const { return !exact.empty(); }
  std::optional<std::size_t> self_reference;
};

/// One row of the table.
struct StudyPoint {
  std::size_t sweep = 0;
  std::size_t run = 0;
  std::string method;
  std::string integrator;
  StudySetting setting;
  std::optional<std::size_t> half{};  ///< run with half the step (Impossible::kept)
};

struct Study {
  std::string name;   ///< stem of the file
  std::string title;  ///< its first comment
  std::filesystem::path file;
  std::filesystem::path scene;
  std::string text;            ///< of the file
  std::string self_reference;  ///< "backward-euler step 0.78125"; empty if there is none
  bool compared = true;        ///< false: without references, no errors (reference = "none")
  std::vector<SweepPoint> sweep;
  std::map<std::string, std::string> units;  ///< of the swept keys; "" for those that have none
  std::vector<StudyPoint> points;
  std::vector<StudyRun> runs;  ///< of points and references; equal scenes are one run
};

/// Treatment of runs with impossible scenes: the study is refused, or, for verdicts on every run
/// (extremes.hpp), the runs are kept and the program refuses them one by one; those with a fixed
/// step are then also done with half of it.
enum class Impossible { refused, kept };

/// Reads a study and checks all of it: every scene resolves and has a model. Throws InputError with
/// one line naming file, line, key and what was expected. If impossible scenes are kept, it throws
/// only for mistakes of the file itself, including names of keys; errors are then measured only at
/// time.end, unless the file names times.
Study load_study(const std::filesystem::path& file, Impossible impossible = Impossible::refused);

/// The help text of a study file's keys.
std::string describe_study_keys();

struct StudyOptions {
  std::filesystem::path folder;   ///< of the results
  std::filesystem::path program;  ///< gnomon itself
  int jobs = 1;                   ///< processes at the same time
  bool resume = false;            ///< keep finished runs in an existing folder
  double limit = 0;               ///< wall time after which a run is killed [s]; 0: no limit
  /// Wall time without a sign of life after which another process has lost its run [s].
  double lost_after = 120;
};

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;          ///< meaningful when signal is 0
  int signal = 0;             ///< that ended the process
  bool timed_out = false;     ///< killed at StudyOptions::limit
  double cpu_seconds = 0;     ///< user and system
  double peak_memory_mb = 0;  ///< [10^6 bytes]
};

struct StudyProgress {
  std::size_t total = 0;   ///< runs to do
  std::size_t kept = 0;    ///< done by an earlier call
  std::size_t done = 0;    ///< including kept ones
  std::size_t failed = 0;  ///< part of the done ones
  std::size_t others = 0;  ///< left to other processes that are doing them
  std::string ended;       ///< name of the run that has just ended, if any
  std::string reason;      ///< why it failed, if it failed
};

struct StudyHooks {
  std::function<void(const StudyProgress&)> on_progress = [](const StudyProgress&) {};
  /// What the user should know, but what does not end the study.
  std::function<void(const std::string&)> on_warning = [](const std::string&) {};
  /// Called repeatedly; true stops the running processes and ends the study.
  std::function<bool()> interrupted = [] { return false; };
};

/// Makes the folder of a study, with the scenes of all its runs. Throws InputError for a folder
/// that exists (unless `resume`), is not that of a study, holds a study of another name, or is in
/// use.
void plan_study(const Study& study, const std::filesystem::path& folder, bool resume);

/// Plans the study and does the runs that are not done yet; every run has its files in FOLDER/runs.
/// Several processes may do the runs of a study, on machines that share the folder: no run is done
/// twice at a time, and one that another process does is waited for. Throws as plan_study().
/// Returns the progress at the end, which is incomplete after an interruption: the runs are then
/// continued by the next call where they are.
StudyProgress run_study(const Study& study, const StudyOptions& options, const StudyHooks& hooks);

/// Does some of the runs of a planned study, given by their index; leaves those that others do.
StudyProgress run_planned(const Study& study, const std::vector<std::size_t>& runs,
                          const StudyOptions& options, const StudyHooks& hooks);

/// The runs of a study as job arrays of Slurm, the scheduler of many clusters. Its programs sbatch
/// and squeue are called; jobs share the study's folder, and nothing else is needed.
struct SlurmOptions {
  std::vector<std::string> sbatch;  ///< further options of sbatch, as "--time=60"
  int at_most = 0;   ///< jobs of an array at the same time; 0: as many as Slurm allows
  double poll = 10;  ///< between looks at the jobs [s]
};

/// Plans the study, submits the runs that are not done, and submits those again whose jobs have
/// ended before them (preempted, out of time, lost with their machine), until all are done or make
/// no progress. After an interruption the jobs go on; a later call with `resume` finds them. Throws
/// as plan_study(), and Error with the words of sbatch when it refuses.
StudyProgress run_study_by_slurm(const Study& study, const StudyOptions& options,
                                 const SlurmOptions& slurm, const StudyHooks& hooks);

/// The study that was planned in this folder, without the scenes of its runs and without closed
/// forms. Throws InputError.
Study read_plan(const std::filesystem::path& folder);
/// All of it.
Study read_whole_plan(const std::filesystem::path& folder);

/// The runs of a study with its scenes that are not done, in the order in which they are best done.
std::vector<std::size_t> missing_runs(const Study& study, const std::filesystem::path& folder);

/// Whether the folder contains the results of a study.
bool holds_study(const std::filesystem::path& folder);

/// How a run ended.
struct RunRecord {
  bool complete = false;                ///< it ended by itself and wrote its summary
  std::string status{};                 ///< "finished", "failed", "missing"
  std::string reason{};                 ///< of a failure
  std::vector<std::string> warnings{};  ///< of the run
  std::optional<Counters> counters{};
  std::optional<double> wall_seconds{};  ///< of the run itself
  std::optional<double> reached{};       ///< time of the last good state, finished or not
  std::optional<ProcessEnd> end{};       ///< absent if it was not run
};

/// One row of the results. Errors are absent if a run or its reference has failed.
struct StudyRow : RunRecord {
  StudyPoint point;
  std::string sweep;
  std::optional<double> shape_error;       ///< at the end [length]
  std::optional<double> shape_error_max;   ///< largest at the measured times [length]
  std::optional<double> shape_error_self;  ///< at the end, against the self-reference [length]
  std::optional<double> pressure_error;    ///< at the end, largest of a node [stress]
  bool marked_shape =
      false;  ///< below ten times the error of the reference, or the latter is unknown
  bool marked_max = false;
  bool marked_pressure = false;
  RunRecord half;                    ///< of the run with half the step, if there is one
  std::optional<double> half_error;  ///< its shape error at the end
  std::vector<Scalar> observed;      ///< at the end of a finished run: worn volume, pressure, ...
};

/// The reference of the errors of one sweep point, and its own error.
struct StudyReference {
  std::string text;  ///< "esdirk-5 rtol 1e-09, checked by bdf rtol 1e-09"; "closed form"
  bool usable = false;
  std::optional<double> error;      ///< difference of the two runs at the end [length]
  std::optional<double> error_max;  ///< largest at the measured times [length]
  std::optional<double> pressure_error;
  double wear = 0;      ///< Euclidean norm of the wear of all contact nodes at the end [length]
  double pressure = 0;  ///< largest nodal contact pressure at the end [stress]
};

struct StudyTable {
  std::vector<StudyRow> rows;
  std::vector<StudyReference> references;  ///< one per sweep point
};

/// Measures the errors of the runs in `folder`.
StudyTable measure(const Study& study, const std::filesystem::path& folder);

/// The table as CSV: the columns of docs/studies.md.
std::string study_csv(const Study& study, const StudyTable& table);
/// All that a page of the study shows, as JSON: what it is of, columns with units and meanings,
/// rows, references, the study's text.
std::string study_json(const Study& study, const StudyTable& table);
/// The table and the study's text as HDF5. Throws Error.
void write_study_hdf5(const std::filesystem::path& file, const Study& study,
                      const StudyTable& table);

}  // namespace gnomon
