// gnomon study: many runs of one scene, their errors and costs.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/study.hpp>
#include <thread>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/run_end.hpp"
#include "app/study_figures.hpp"
#include "app/study_progress.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

StudyOptions study_options(const Study& study, const StudyCommandOptions& given) {
  StudyOptions options;
  options.folder = given.folder.empty() ? fs::path(study.name) : given.folder;
  options.program = fs::read_symlink("/proc/self/exe");
  options.jobs = given.jobs > 0
                     ? given.jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.resume = given.resume;
  return options;
}

StudyProgress run_all(const Study& study, const StudyOptions& options, bool quiet) {
  StudyProgressBar bar(Progress::mode_for_stderr(quiet));
  const StudyHooks hooks{.on_progress = [&](const StudyProgress& p) { bar.show(p); },
                         .interrupted = InterruptGuard::interrupted};
  try {
    const StudyProgress progress = run_study(study, options, hooks);
    bar.finish();
    return progress;
  } catch (const std::exception&) {
    bar.finish();  // before the message about it
    throw;
  }
}

std::string error_text(const std::optional<double>& error, bool marked) {
  return error ? fmt::format("{:.2e}{}", *error, marked ? "*" : " ") : "- ";
}

std::string own_error_text(const SweepPoint& sweep, const std::optional<double>& error) {
  if (sweep.has_closed_form()) return "exact";
  return error ? fmt::format("own error {:.2e}", *error) : "own error unknown";
}

void print_table(const Study& study, const StudyTable& table) {
  constexpr auto right = TextTable::Align::right;
  TextTable text({{"sweep"},
                  {"run"},
                  {"shape error [mm]", right},
                  {"steps", right},
                  {"factors", right},
                  {"CPU [s]", right},
                  {}});
  for (const StudyRow& row : table.rows)
    text.add({row.sweep, study.runs[row.point.run].title,
              error_text(row.shape_error, row.marked_shape),
              row.counters ? fmt::format("{}", row.counters->steps) : "-",
              row.counters ? fmt::format("{}", row.counters->factorizations) : "-",
              row.cpu_seconds ? fmt::format("{:.2f}", *row.cpu_seconds) : "-",
              row.status == "finished" ? "" : row.status + ": " + row.reason});
  fmt::print("{}", text.text());
  for (std::size_t i = 0; i < table.references.size(); ++i) {
    const std::string& label = study.sweep[i].label;
    fmt::print("reference{}: {}, {}\n", label.empty() ? "" : " at " + label,
               table.references[i].text, own_error_text(study.sweep[i], table.references[i].error));
  }
  const bool marked = std::any_of(table.rows.begin(), table.rows.end(),
                                  [](const StudyRow& row) { return row.marked_shape; });
  if (marked)
    fmt::print("* less than ten times the error of the reference, or the latter is unknown\n");
}

}  // namespace

int study_command(const StudyCommandOptions& given) {
  const Study study = load_study(given.study);
  const StudyOptions options = study_options(study, given);
  if (!given.quiet) warn_of_slow_blas();
  const InterruptGuard guard(
      false);  // until the page is written: a half-written page would be useless
  const StudyProgress progress = run_all(study, options, given.quiet);
  if (progress.done < progress.total)
    throw Error(fmt::format("interrupted with {} of {} runs done; --resume continues from there",
                            progress.done, progress.total));
  const StudyTable table = measure(study, options.folder);
  write_file(options.folder / "study.csv", study_csv(study, table), Earlier::replaced);
  write_study_hdf5(options.folder / "study.h5", study, table);
  const StudyFigures figures = study_figures(options.folder, "study");
  write_file(options.folder / "index.html", study_page(study, table, figures.svgs, figures.note),
             Earlier::replaced);
  if (!given.quiet) {
    print_table(study, table);
    fmt::print("{}{}results: {} (index.html, study.csv, study.h5, runs)\n", figures.note,
               figures.note.empty() ? "" : "\n", options.folder.string());
  }
  if (std::ranges::none_of(table.rows,
                           [](const StudyRow& row) { return row.status == "finished"; }))
    throw SolutionError(fmt::format("all {} runs of the table failed (reasons in {})",
                                    table.rows.size(), (options.folder / "study.csv").string()));
  return success;
}

}  // namespace gnomon::app
