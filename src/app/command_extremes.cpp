// gnomon extremes: runs studies at the extremes of their parameters and judges every run.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/extremes.hpp>
#include <iterator>
#include <map>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/plotting_script.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* table_file =
    "extremes.csv";  // its presence shows that a folder is that of a suite

/// The study files among these, and those in folders among these.
std::vector<fs::path> study_files(std::vector<fs::path> given) {
  if (given.empty())
    for (const auto& problem : fs::directory_iterator(installed("share/gnomon/problems")))
      if (fs::is_directory(problem.path() / "extremes"))
        given.push_back(problem.path() / "extremes");
  std::vector<fs::path> files;
  for (const fs::path& path : given) {
    if (!fs::is_directory(path))
      files.push_back(path);
    else
      for (auto entry = fs::recursive_directory_iterator(path); entry != fs::end(entry); ++entry) {
        if (fs::exists(entry->path() / table_file))
          entry.disable_recursion_pending();  // earlier results
        if (entry->path().extension() == ".toml") files.push_back(entry->path());
      }
  }
  if (files.empty()) throw InputError("expected study files, got none");
  std::sort(files.begin(), files.end());
  return files;
}

/// "PROBLEM-STEM" for a file in problems/PROBLEM/extremes; the stem for other files.
std::string name_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  const std::string stem = file.stem().string();
  return folder.filename() == "extremes" ? folder.parent_path().filename().string() + "-" + stem
                                         : stem;
}

/// Studies by their names in the suite.
using Suite = std::map<std::string, Study>;

Suite load_suite(const std::vector<fs::path>& files) {
  Suite suite;
  for (const fs::path& file : files)
    if (!suite.try_emplace(name_of(file), load_study(file, Impossible::kept)).second)
      throw InputError(
          fmt::format("{}: there are two studies called \"{}\", expected different names",
                      file.string(), name_of(file)));
  return suite;
}

/// The table is rewritten, and the cases of all studies that it held must stay in it.
void check_holds_only(const fs::path& folder, const Suite& suite) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (holds_study(entry.path()) && !suite.contains(name))
      throw InputError(fmt::format("{}: holds study \"{}\", expected it among those to resume",
                                   folder.string(), name));
  }
}

void prepare_folder(const fs::path& folder, bool resume, const Suite& suite) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    if (!fs::exists(folder / table_file, error))
      throw InputError(
          fmt::format("{}: holds something else, expected a new name or the folder of "
                      "an earlier gnomon extremes",
                      folder.string()));
    if (!resume)
      throw InputError(fmt::format(
          "{}: exists already, expected a new name, or --resume to continue", folder.string()));
    check_holds_only(folder, suite);
  }
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  write_file(folder / table_file, extremes_csv({}), Earlier::replaced);
}

/// All studies, one after the other; several runs of a study at the same time.
void run_all(const Suite& suite, const StudyCommandOptions& given) {
  StudyOptions options = options_of_runs(given);
  StudyProgress before;
  for (const auto& [name, study] : suite) before.total += study.runs.size();
  const auto with_those_before = [&](StudyProgress progress) {
    progress.total = before.total;
    progress.kept += before.kept;
    progress.done += before.done;
    progress.failed += before.failed;
    return progress;
  };
  const StudyProgressBar bar(given.quiet);
  StudyHooks hooks = bar.hooks();
  hooks.on_progress = [&](const StudyProgress& p) { bar.show(with_those_before(p)); };
  for (const auto& [name, study] : suite) {
    options.folder = given.folder / name;
    const StudyProgress progress = run_study(study, options, hooks);
    before = with_those_before(progress);
    if (progress.done < progress.total) break;
  }
  if (before.done < before.total)
    throw Error(fmt::format("interrupted with {} of {} runs done; --resume continues from there",
                            before.done, before.total));
}

std::string number(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

/// Every case; the faults come last, so that they stay visible on a terminal.
void print_cases(const std::vector<ExtremeCase>& cases) {
  TextTable text("llllrrrrrl", {"verdict", "study", "sweep", "run", "difference", "bound",
                                "pressure", "steps", "wall [s]", ""});
  for (const bool faults : {false, true})
    for (const ExtremeCase& c : cases)
      if (c.verdict.fault == faults)
        text.add({c.verdict.name, c.study, c.row.sweep, c.run.title, number(c.difference, "{:.1e}"),
                  number(c.bound, "{:.1e}"), number(c.pressure_difference, "{:.1e}"),
                  c.row.counters ? fmt::format("{}", c.row.counters->steps) : "-",
                  number(c.row.wall_seconds, "{:.2f}"), c.reason});
  fmt::print("{}", text.text());
}

std::string counts_text(const std::vector<ExtremeCase>& cases) {
  std::map<std::string, int> counts;
  for (const ExtremeCase& c : cases) ++counts[c.verdict.name];
  std::vector<std::string> parts;
  for (const Verdict& verdict : verdicts::all)
    if (const int count = counts[verdict.name]; count > 0)
      parts.push_back(fmt::format("{} {}", count, verdict.name));
  return fmt::format("{} cases: {}", cases.size(), fmt::join(parts, ", "));
}

}  // namespace

void extremes_command(const StudyCommandOptions& given) {
  const Suite suite = load_suite(study_files(given.studies));
  prepare_folder(given.folder, given.resume, suite);
  if (!given.quiet) warn_of_slow_blas();
  const InterruptGuard guard(false);  // until the page is written, as for a study
  run_all(suite, given);

  std::vector<ExtremeCase> cases;
  for (const auto& [name, study] : suite)
    std::ranges::move(judge(study, name, given.folder / name), std::back_inserter(cases));
  write_file(given.folder / table_file, extremes_csv(cases), Earlier::replaced);
  write_file(given.folder / "extremes.json", extremes_json(cases), Earlier::replaced);
  const DrawnPage page = draw_page(given.folder, "extremes");
  if (!given.quiet) {
    print_cases(cases);
    fmt::print("{}{}\nresults: {} ({}{}, extremes.json, one folder per study)\n", page.complaint,
               counts_text(cases), given.folder.string(), page.listed(), table_file);
  }
  const auto faults =
      std::ranges::count_if(cases, [](const ExtremeCase& c) { return c.verdict.fault; });
  if (faults > 0)
    throw Error(fmt::format("{} of {} cases are wrong, hung or crashed", faults, cases.size()));
}

}  // namespace gnomon::app
