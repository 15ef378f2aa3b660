// gnomon study: many runs of one scene, their errors, results and costs; as a whole, or in parts:
// plan, run, collect.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/study/slurm.hpp>
#include <gnomon/study/study.hpp>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/program.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"
#include "app/study_tables.hpp"
#include "study/run_numbers.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const Study& study, const StudyCommandOptions& given) {
  return given.folder.empty() ? fs::path(study.name) : given.folder;
}

StudyOptions study_options(const fs::path& folder, const StudyCommandOptions& given) {
  StudyOptions options = options_of_runs(given.jobs, given.resume);
  options.folder = folder;
  options.lost_after = given.lost_after;
  return options;
}

/// Does runs and shows their progress.
template <class Do>
StudyProgress with_progress(bool quiet, const Do& run) {
  StudyProgressBar bar(Progress::mode_for_stderr(quiet));
  const StudyHooks hooks{.on_progress = [&](const StudyProgress& p) { bar.show(p); },
                         .interrupted = InterruptGuard::interrupted};
  try {
    const StudyProgress progress = run(hooks);
    bar.finish();
    return progress;
  } catch (const std::exception&) {
    bar.finish();  // before the message about it
    throw;
  }
}

/// The whole study on this machine, or by Slurm.
StudyProgress run_all(const Study& study, const StudyOptions& options,
                      const StudyCommandOptions& given, const StudyHooks& hooks) {
  if (given.executor == "local") return run_study(study, options, hooks);
  SlurmOptions slurm;
  slurm.sbatch = given.slurm_options;
  slurm.at_most = given.jobs;
  slurm.poll = given.poll;
  return run_study_by_slurm(study, options, slurm, hooks);
}

std::string count_text(std::size_t count) {
  return count == 1 ? "1 run" : fmt::format("{} runs", count);
}

/// Throws Error that names the missing runs, if there are any.
void require_complete(const Study& study, const fs::path& folder) {
  const std::vector<std::size_t> missing = missing_runs(study, folder);
  if (missing.empty()) return;
  const std::string numbers = study::numbers_of(missing);
  throw Error(fmt::format("{} of {} missing; gnomon study run {} {} does {}",
                          count_text(missing.size()), study.runs.size(), folder.string(), numbers,
                          missing.size() == 1 ? "it" : "them"));
}

}  // namespace

int study_command(const StudyCommandOptions& given) {
  if (given.study.empty())
    throw InputError("expected a study file, or plan, run or collect, see `gnomon help study`");
  const Study study = load_study(given.study);
  const StudyOptions options = study_options(folder_of(study, given), given);
  if (!given.quiet) warn_of_slow_blas();
  const InterruptGuard guard(
      false);  // until the page is written: a half-written page would be useless
  const StudyProgress progress = with_progress(
      given.quiet, [&](const StudyHooks& hooks) { return run_all(study, options, given, hooks); });
  if (InterruptGuard::interrupted() && progress.done < progress.total)
    throw Error(fmt::format("interrupted with {} of {} runs done{}; --resume continues from there",
                            progress.done, progress.total,
                            given.executor == "slurm" ? ", the jobs of Slurm continue" : ""));
  write_study(study, options.folder, given.quiet);
  if (progress.done < progress.total) require_complete(study, options.folder);
  return success;
}

int study_plan_command(const StudyCommandOptions& given) {
  const Study study = load_study(given.study);
  const fs::path folder = folder_of(study, given);
  plan_study(study, folder, given.resume);
  if (!given.quiet)
    fmt::print(
        "{}: {}, listed in plan.csv; gnomon study run {} NUMBERS does them, gnomon study "
        "collect {} makes the tables\n",
        folder.string(), count_text(study.runs.size()), folder.string(), folder.string());
  return success;
}

int study_run_command(const StudyCommandOptions& given) {
  const Study study = read_plan(given.folder);
  const std::vector<std::size_t> runs = study::runs_numbered(given.numbers, study.runs.size());
  const StudyOptions options = study_options(given.folder, given);
  const InterruptGuard guard(false);
  const StudyProgress progress = with_progress(given.quiet, [&](const StudyHooks& hooks) {
    return run_planned(study, runs, options, hooks);
  });
  if (progress.others > 0 && !given.quiet)
    fmt::print("{} left to other processes that are doing them\n", count_text(progress.others));
  if (progress.done + progress.others < progress.total)
    throw Error(fmt::format("interrupted with {} of {} runs done; the same command continues",
                            progress.done, progress.total));
  if (progress.failed > 0 && !given.quiet)
    fmt::print("{} failed, for a reason that gnomon study collect tells\n",
               count_text(progress.failed));
  return success;
}

int study_collect_command(const StudyCommandOptions& given) {
  const Study study = read_whole_plan(given.folder);
  const InterruptGuard guard(false);
  try {
    write_study(study, given.folder, given.quiet);
  } catch (const SolutionError&) {
    require_complete(study, given.folder);
    throw;  // all runs failed, not only those that are done
  }
  require_complete(study, given.folder);
  return success;
}

}  // namespace gnomon::app
