// The commands of the program, one function each. They print to stdout (progress to stderr), and
// throw on bad input. A run may also end with another exit code than 0 without an error.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// Of a new run, and of one that is resumed.
struct RunOptions {
  std::filesystem::path scene{};         ///< of a new run
  std::vector<std::string> overrides{};  ///< "key=value", --integrator included
  std::optional<double> end{};           ///< of a resumed run, instead of the scene's
  std::filesystem::path result{};        ///< empty: SCENE-INTEGRATOR.h5, in the current folder
  std::filesystem::path summary{};       ///< empty: none; "-": standard output
  bool force = false;  ///< replace the files of earlier runs with these names; resumed: the summary
  bool quiet = false;
};

/// Of a study, and of studies at the extremes.
struct StudyCommandOptions {
  std::filesystem::path study{};
  std::vector<std::filesystem::path>
      studies{};                             ///< extremes: files, folders; empty: all of gnomon's
  std::filesystem::path folder{};            ///< empty: the study's name, in the current folder
  std::string numbers{};                     ///< of the runs to do: "3", "3-7", "3,5,9-12"
  int jobs = 0;                              ///< 0: one a core; by Slurm: as many as it allows
  double limit = 0;                          ///< StudyOptions::limit
  std::string executor = "local";            ///< or "slurm"
  std::vector<std::string> slurm_options{};  ///< for sbatch
  double poll = 10;                          ///< between looks at Slurm's jobs [s]
  double lost_after = 120;                   ///< StudyOptions::lost_after
  bool resume = false;
  bool quiet = false;
};

struct StabilityOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::vector<double> times;         ///< empty: start, a fifth of time.end, time.end
  std::vector<std::string> methods;  ///< explicit ones; empty: all of them
  bool all = false;                  ///< compute the whole spectrum
  double rtol = 1e-5;                ///< of the run to the states
  bool no_onset = false;             ///< do not measure the onset of instability
  std::filesystem::path folder;      ///< for the tables as CSV; empty: none
};

struct BudgetOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  bool json = false;  ///< print it as JSON
  bool quiet = false;
};

int run_command(const RunOptions& options);
int resume_command(const RunOptions& options);
void study_command(const StudyCommandOptions& options);
/// The parts of a study: the folder, some runs of it, the tables.
void study_plan_command(const StudyCommandOptions& options);
void study_run_command(const StudyCommandOptions& options);
void study_collect_command(const StudyCommandOptions& options);
/// Throws Error when a case is wrong, hung or crashed.
void extremes_command(const StudyCommandOptions& options);
void check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides);
/// `what` empty: the subjects.
void list_command(const std::string& what);
void info_command(const std::filesystem::path& result);
/// `time` as it was printed: "350", "350 s"; empty: the last one.
void contact_command(const std::filesystem::path& result, const std::string& time);
/// The scene of a result, as `check` prints it.
void scene_command(const std::filesystem::path& result);
/// One line for each step, the start first: time, step, counters, scalars.
void history_command(const std::filesystem::path& result);
/// What a mesh, or that of a result, has: cells, named parts, remarks. `size`: longest edge for a
/// geometry. `written`: a picture of it, a file for ParaView, or the mesh that a run would use
/// (.msh, a new file); empty: none.
void mesh_command(const std::filesystem::path& file, std::optional<double> size,
                  const std::filesystem::path& written);
/// Writes a scene for a mesh; `scene` empty: beside the mesh. Never replaces a file.
void new_command(const std::filesystem::path& file, std::optional<double> size,
                 std::filesystem::path scene);
/// `reference` empty: the last of the results.
void compare_command(const std::vector<std::filesystem::path>& results,
                     const std::filesystem::path& reference);
void budget_command(const BudgetOptions& options);
void plan_command(const BudgetOptions& options);
void stability_command(const StabilityOptions& options);
/// Figures of results and of folders with studies or spectra. `folder` empty: beside each of them.
void plot_command(const std::vector<std::filesystem::path>& targets,
                  const std::filesystem::path& folder);
/// The help topics that are not commands, in the order of the overview.
const std::vector<std::string>& help_topics();
/// The text of one of them; of scenes for all problems, or for one.
std::string topic_text(const std::string& topic, const std::optional<std::string>& problem = {});
void version_command();

/// The subjects of `gnomon list`.
std::vector<std::string> list_subjects();

/// Throws InputError if a file that the run writes is the same as another one that it writes or
/// reads, or exists and must not be replaced, or cannot be written.
void check_outputs(const RunOptions& options);

/// Writes the summary to the file that the options name. The summary of a run that failed at its
/// start does not replace an earlier one, so that the files of the earlier run stay together.
/// Throws Error.
void write_summary(const RunOptions& options, const std::string& text, bool started);

/// Of the stored `times`, ascending, the nearest that is `text` when it is rounded to the digits of
/// `text`: "350", "350 s", "t = 3.5e2". Throws InputError, which begins with `file` and names the
/// times next to it.
double stored_time(const std::vector<double>& times, const std::string& text,
                   const std::string& file);

/// A check of an argument as CLI11 requires it: a complaint unless the text is a time.
std::string check_time(const std::string& text);

}  // namespace gnomon::app
