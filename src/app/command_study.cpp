// gnomon study: many runs of one scene, their errors, results and costs; as a whole, or in parts:
// plan, run, collect.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/study.hpp>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/plotting_script.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"
#include "app/text_table.hpp"
#include "mesh/shared_meshes.hpp"
#include "study/run_files.hpp"
#include "study/run_warnings.hpp"
#include "study/table.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const Study& study, const StudyCommandOptions& given) {
  return given.folder.empty() ? fs::path(study.name) : given.folder;
}

/// The whole study on this machine, or by Slurm.
StudyProgress run_all(const Study& study, const StudyOptions& options,
                      const StudyCommandOptions& given, const StudyHooks& hooks) {
  if (given.executor == "local") return run_study(study, options, hooks);
  return run_study_by_slurm(
      study, options, {.sbatch = given.slurm_options, .at_most = given.jobs, .poll = given.poll},
      hooks);
}

/// Throws Error that names the missing runs, if there are any.
void require_complete(const Study& study, const fs::path& folder) {
  const std::vector<std::size_t> missing = missing_runs(study, folder);
  if (missing.empty()) return;
  const std::string numbers = study::numbers_of(missing);
  throw Error(fmt::format("{} of {} missing; gnomon study run {} {} does {}",
                          study::count_of_runs(missing.size()), study.runs.size(), folder.string(),
                          numbers, missing.size() == 1 ? "it" : "them"));
}

std::string error_text(const std::optional<double>& error, bool marked) {
  return error ? fmt::format("{:.2e}{}", *error, marked ? "*" : " ") : "- ";
}

std::string own_error_text(const SweepPoint& sweep, const std::optional<double>& error) {
  if (sweep.has_closed_form()) return "exact";
  return error ? fmt::format("own error {:.2e}", *error) : "own error unknown";
}

/// What a table on the terminal has room for, where a study measures no errors.
constexpr const char* shown[] = {"worn_volume", "max_pressure", "contact_half_width"};

/// Name and unit of a shown quantity; empty if no run has observed it.
std::string shown_title(const StudyTable& table, const std::string& name) {
  for (const StudyRow& row : table.rows)
    if (const Scalar* const scalar = find_scalar(row.observed, name))
      return fmt::format("{} [{}]", name, scalar->unit);
  return {};
}

std::string status_text(const StudyRow& row) {
  return row.status == "finished" ? "" : row.status + ": " + row.reason;
}

/// The results of a parameter sweep.
void print_observed(const Study& study, const StudyTable& table) {
  std::string alignment = "ll";
  std::vector<std::string> titles = {"sweep", "run"};
  std::vector<std::string> names;
  for (const char* name : shown)
    if (const std::string title = shown_title(table, name); !title.empty()) {
      alignment += "r";
      titles.push_back(title);
      names.push_back(name);
    }
  titles.insert(titles.end(), {"CPU [s]", ""});
  TextTable text(alignment + "rl", titles);
  for (const StudyRow& row : table.rows) {
    std::vector<std::string> cells = {row.sweep, study.runs[row.point.run].title};
    for (const std::string& name : names) {
      const Scalar* const scalar = find_scalar(row.observed, name);
      cells.push_back(scalar ? fmt::format("{:.5g}", scalar->value) : "-");
    }
    cells.push_back(row.end ? fmt::format("{:.2f}", row.end->cpu_seconds) : "-");
    cells.push_back(status_text(row));
    text.add(cells);
  }
  fmt::print("{}", text.text());
}

void print_errors(const Study& study, const StudyTable& table) {
  TextTable text("llrrrrl",
                 {"sweep", "run", "shape error [mm]", "steps", "factors", "CPU [s]", ""});
  for (const StudyRow& row : table.rows)
    text.add({row.sweep, study.runs[row.point.run].title,
              error_text(row.shape_error, row.marked_shape),
              row.counters ? fmt::format("{}", row.counters->steps) : "-",
              row.counters ? fmt::format("{}", row.counters->factorizations) : "-",
              row.end ? fmt::format("{:.2f}", row.end->cpu_seconds) : "-", status_text(row)});
  fmt::print("{}", text.text());
  for (std::size_t i = 0; i < table.references.size(); ++i) {
    const std::string& label = study.sweep[i].label;
    fmt::print("reference{}: {}, {}\n", label.empty() ? "" : " at " + label,
               table.references[i].text, own_error_text(study.sweep[i], table.references[i].error));
  }
  const bool marked = std::ranges::any_of(table.rows, &StudyRow::marked_shape);
  if (marked)
    fmt::print("* less than ten times the error of the reference, or the latter is unknown\n");
}

/// The cheapest run of each accuracy.
void print_advice(const Study& study, const StudyTable& table) {
  TextTable text(
      "lrlrrr", {"sweep", "error / wear", "cheapest run", "shape error [mm]", "Newton", "CPU [s]"});
  const auto found = study::recommendations(table);
  for (const auto& each : found) {
    std::vector<std::string> cells = {study.sweep[each.sweep].label,
                                      fmt::format("{:.0e}", each.error)};
    if (each.row) {
      const StudyRow& row = table.rows[*each.row];
      cells.insert(cells.end(),
                   {study.runs[row.point.run].title, fmt::format("{:.2e}", *row.shape_error),
                    fmt::format("{}", row.counters->newton_iterations),
                    fmt::format("{:.2f}", row.end->cpu_seconds)});
    } else {
      cells.insert(cells.end(), {"none of these", "-", "-", "-"});
    }
    text.add(cells);
  }
  if (!found.empty()) fmt::print("recommended:\n{}", text.text());
  if (const std::string remark = study::hidden_tolerances(study, table); !remark.empty())
    fmt::print("{}\n", remark);
}

/// Measures the runs, writes study.csv, study.json, study.h5 and the page, and prints the table.
StudyTable write_study(const Study& study, const std::filesystem::path& folder, bool quiet) {
  const StudyTable table = measure(study, folder);
  write_file(folder / "study.csv", study_csv(study, table), Earlier::replaced);
  write_study_hdf5(folder / "study.h5", study, table);
  write_file(folder / "study.json", study_json(study, table), Earlier::replaced);
  const DrawnPage page = draw_page(folder, "study");
  if (!quiet) {
    study.compared ? print_errors(study, table) : print_observed(study, table);
    if (study.compared) print_advice(study, table);
    fmt::print("{}", study::warnings_text(study::warnings_of(study, table)));
    fmt::print("{}results: {} ({}study.csv, study.json, study.h5, runs)\n", page.complaint,
               folder.string(), page.listed());
  }
  return table;
}

/// Throws SolutionError when no run has finished. Called where none is missing.
void require_finished(const StudyTable& table, const fs::path& folder) {
  if (std::ranges::none_of(table.rows,
                           [](const StudyRow& row) { return row.status == "finished"; }))
    throw SolutionError(fmt::format("all {} runs of the table failed (reasons in {})",
                                    table.rows.size(), (folder / "study.csv").string()));
}

}  // namespace

void study_command(const StudyCommandOptions& given) {
  if (given.study.empty())
    throw InputError("expected a study file, or plan, run or collect, see `gnomon help study`");
  const SharedMeshes meshes;  // made where the study is read, so that no run has their cost
  const Study study = load_study(given.study);
  StudyOptions options = options_of_runs(given);
  options.folder = folder_of(study, given);
  if (!given.quiet) warn_of_slow_blas();
  const InterruptGuard guard(
      false);  // until the page is written: a half-written page would be useless
  const StudyProgress progress =
      run_all(study, options, given, StudyProgressBar(given.quiet).hooks());
  if (InterruptGuard::interrupted() && progress.done < progress.total)
    throw Error(fmt::format("interrupted with {} of {} runs done{}; --resume continues from there",
                            progress.done, progress.total,
                            given.executor == "slurm" ? ", the jobs of Slurm continue" : ""));
  const StudyTable table = write_study(study, options.folder, given.quiet);
  if (progress.done < progress.total) require_complete(study, options.folder);
  require_finished(table, options.folder);
}

void study_plan_command(const StudyCommandOptions& given) {
  const Study study = load_study(given.study);
  const fs::path folder = folder_of(study, given);
  plan_study(study, folder, given.resume);
  if (!given.quiet)
    fmt::print(
        "{}: {}, listed in plan.csv; gnomon study run {} NUMBERS does them, gnomon study "
        "collect {} makes the tables\n",
        folder.string(), study::count_of_runs(study.runs.size()), folder.string(), folder.string());
}

void study_run_command(const StudyCommandOptions& given) {
  const SharedMeshes meshes;
  const Study study = read_plan(given.folder);
  const std::vector<std::size_t> runs = study::runs_numbered(given.numbers, study.runs.size());
  const StudyOptions options = options_of_runs(given);
  const InterruptGuard guard(false);
  const StudyProgress progress =
      run_planned(study, runs, options, StudyProgressBar(given.quiet).hooks());
  if (progress.others > 0 && !given.quiet)
    fmt::print("{} left to other processes that are doing them\n",
               study::count_of_runs(progress.others));
  if (progress.done + progress.others < progress.total)
    throw Error(fmt::format("interrupted with {} of {} runs done; the same command continues",
                            progress.done, progress.total));
  if (progress.failed > 0 && !given.quiet)
    fmt::print("{} failed, for a reason that gnomon study collect tells\n",
               study::count_of_runs(progress.failed));
}

void study_collect_command(const StudyCommandOptions& given) {
  const Study study = read_whole_plan(given.folder);
  const InterruptGuard guard(false);
  const StudyTable table = write_study(study, given.folder, given.quiet);
  require_complete(study, given.folder);
  require_finished(table, given.folder);
}

}  // namespace gnomon::app
