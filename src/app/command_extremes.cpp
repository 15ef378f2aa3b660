// gnomon extremes: runs studies at the extremes of their parameters and judges every run.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/extremes.hpp>
#include <map>
#include <thread>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/run_end.hpp"
#include "app/study_page.hpp"
#include "app/study_progress.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* table_file =
    "extremes.csv";  // its presence shows that a folder is that of a suite

std::vector<fs::path> toml_files_below(const fs::path& folder, const std::string& in = "") {
  std::vector<fs::path> files;
  for (auto place = fs::recursive_directory_iterator(folder); place != fs::end(place); ++place) {
    const fs::directory_entry& entry = *place;
    if (fs::exists(entry.path() / table_file))
      place.disable_recursion_pending();  // earlier results
    if (entry.path().extension() == ".toml" &&
        (in.empty() || entry.path().parent_path().filename() == in))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> study_files(const std::vector<fs::path>& given) {
  if (given.empty()) return toml_files_below(installed("share/gnomon/problems"), "extremes");
  std::vector<fs::path> files;
  for (const fs::path& path : given) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const std::vector<fs::path> found = toml_files_below(path);
    files.insert(files.end(), found.begin(), found.end());
  }
  if (files.empty()) throw InputError("expected study files, got none");
  return files;
}

/// "PROBLEM-STEM" for a file in problems/PROBLEM/extremes; the stem for other files.
std::string name_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  const std::string stem = file.stem().string();
  return folder.filename() == "extremes" ? folder.parent_path().filename().string() + "-" + stem
                                         : stem;
}

struct Suite {
  std::string name;
  ExtremeStudy extreme;
};

std::vector<Suite> load_suites(const std::vector<fs::path>& files) {
  std::vector<Suite> suites;
  for (const fs::path& file : files) {
    suites.push_back({name_of(file), load_extreme_study(file)});
    for (std::size_t i = 0; i + 1 < suites.size(); ++i)
      if (suites[i].name == suites.back().name)
        throw InputError(
            fmt::format("{}: there are two studies called \"{}\", expected different "
                        "names",
                        file.string(), suites[i].name));
  }
  return suites;
}

/// The table is rewritten, and the cases of all studies that it held must stay in it.
void check_holds_only(const fs::path& folder, const std::vector<Suite>& suites) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!holds_study(entry.path())) continue;
    if (std::ranges::find(suites, name, &Suite::name) == suites.end())
      throw InputError(fmt::format("{}: holds study \"{}\", expected it among those to resume",
                                   folder.string(), name));
  }
}

void prepare_folder(const fs::path& folder, bool resume, const std::vector<Suite>& suites) {
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
    check_holds_only(folder, suites);
  }
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  write_file(folder / table_file, extremes_csv({}), Earlier::replaced);
}

/// All studies, one after the other; several runs of a study at the same time.
void run_all(const std::vector<Suite>& suites, const ExtremesOptions& given, StudyOptions options) {
  StudyProgressBar bar(Progress::mode_for_stderr(given.quiet));
  StudyProgress before;
  for (const Suite& suite : suites) before.total += suite.extreme.study.runs.size();
  const auto show = [&](const StudyProgress& p) {
    bar.show({.total = before.total,
              .kept = before.kept + p.kept,
              .done = before.done + p.done,
              .failed = before.failed + p.failed,
              .ended = p.ended,
              .reason = p.reason});
  };
  for (const Suite& suite : suites) {
    options.folder = given.folder / suite.name;
    const StudyProgress progress =
        run_study(suite.extreme.study, options,
                  {.on_progress = show, .interrupted = InterruptGuard::interrupted});
    before.kept += progress.kept;
    before.done += progress.done;
    before.failed += progress.failed;
    if (progress.done < progress.total) break;
  }
  bar.finish();
  if (before.done < before.total)
    throw Error(fmt::format("interrupted with {} of {} runs done; --resume continues from there",
                            before.done, before.total));
}

std::string number(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

/// Every case; the faults come last, so that they stay visible on a terminal.
void print_cases(const std::vector<ExtremeCase>& cases) {
  constexpr auto right = TextTable::Align::right;
  TextTable text({{"verdict"},
                  {"study"},
                  {"sweep"},
                  {"run"},
                  {"difference", right},
                  {"bound", right},
                  {"pressure", right},
                  {"steps", right},
                  {"wall [s]", right},
                  {}});
  for (const bool faults : {false, true})
    for (const ExtremeCase& c : cases)
      if (is_fault(c.verdict) == faults)
        text.add({verdict_name(c.verdict), c.study, c.sweep, c.run, number(c.difference, "{:.1e}"),
                  number(c.bound, "{:.1e}"), number(c.pressure_difference, "{:.1e}"),
                  c.counters ? fmt::format("{}", c.counters->steps) : "-",
                  number(c.wall_seconds, "{:.2f}"), c.reason});
  fmt::print("{}", text.text());
}

std::string counts_text(const std::vector<ExtremeCase>& cases) {
  std::map<Verdict, int> counts;
  for (const ExtremeCase& c : cases) ++counts[c.verdict];
  std::string text = fmt::format("{} cases:", cases.size());
  const char* separator = " ";
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{}{} {}", separator, count, verdict_name(verdict));
    separator = ", ";
  }
  return text;
}

}  // namespace

int extremes_command(const ExtremesOptions& given) {
  const std::vector<Suite> suites = load_suites(study_files(given.studies));
  prepare_folder(given.folder, given.resume, suites);
  StudyOptions options;
  options.program = fs::read_symlink("/proc/self/exe");
  options.jobs = given.jobs > 0
                     ? given.jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.resume = given.resume;
  options.limit = given.limit;
  if (!given.quiet) warn_of_slow_blas();
  const InterruptGuard guard(false);  // until the page is written, as for a study
  run_all(suites, given, options);

  std::vector<ExtremeCase> cases;
  for (const Suite& suite : suites) {
    const auto judged = judge(suite.extreme, suite.name, given.folder / suite.name);
    cases.insert(cases.end(), judged.begin(), judged.end());
  }
  write_file(given.folder / table_file, extremes_csv(cases), Earlier::replaced);
  write_file(given.folder / "extremes.json", extremes_json(cases), Earlier::replaced);
  const DrawnPage page = draw_page(given.folder, "extremes");
  if (!given.quiet) {
    print_cases(cases);
    fmt::print("{}{}\nresults: {} ({}{}, extremes.json, one folder per study)\n", page.complaint,
               counts_text(cases), given.folder.string(), page.listed(), table_file);
  }
  const auto faults = std::count_if(cases.begin(), cases.end(),
                                    [](const ExtremeCase& c) { return is_fault(c.verdict); });
  if (faults > 0)
    throw Error(fmt::format("{} of {} cases are wrong, hung or crashed", faults, cases.size()));
  return success;
}

}  // namespace gnomon::app
