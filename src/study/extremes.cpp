#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/study/extremes.hpp>

#include "run/guards.hpp"
#include "study/run_files.hpp"
#include "study/table.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace {

using namespace study;

/// The verdict on one run.
class Judgement {
public:
  Judgement(ExtremeCase& found, const StudyReference& reference, bool is_reference, RunFiles files)
      : case_(found),
        row_(found.row),
        reference_(reference),
        is_reference_(is_reference),
        files_(std::move(files)) {}

  void operator()() {
    case_.pressure_difference = pressure_difference();
    if (!row_.end || row_.end->signal != 0 || row_.end->timed_out)
      return end(row_.end && row_.end->timed_out ? verdicts::hung : verdicts::crashed, row_.reason);
    switch (row_.end->exit_code) {
      case 0:
        return finished();
      case 2:
        return std::filesystem::exists(files_.result)
                   ? end(verdicts::wrong, "refused, but wrote a result: " + row_.reason)
                   : end(verdicts::refused, row_.reason);
      case 3:
        return stopped();
      default:
        return end(verdicts::crashed, row_.reason);
    }
  }

private:
  void end(const Verdict& verdict, const std::string& reason) {
    case_.verdict = verdict;
    case_.reason = reason;
  }

  void stopped() {
    if (row_.reason.empty()) return end(verdicts::wrong, "stopped without a diagnosis");
    if (!holds_last_state())
      return end(verdicts::wrong, "lost the last good state: " + row_.reason);
    end(verdicts::stopped, row_.reason);
  }

  bool holds_last_state() const try {
    if (!row_.reached) return !std::filesystem::exists(files_.result);  // stopped at the start
    const std::vector<double> stored = ResultReader(files_.result).stored_times();
    return !stored.empty() && stored.back() == *row_.reached;
  } catch (const Error&) {
    return false;
  }

  /// The references have this error too, so that they agree in spite of it.
  bool lost_wear() const try {
    const ResultReader result(files_.result);
    const Observation last = result.history().back().scalars;
    return has_lost_wear(last, invisible_volume(result.grid(), dimension_of(last)));
  } catch (const Error&) {
    return false;
  }

  /// None if there is no pressure.
  std::optional<double> pressure_difference() const {
    const auto error = is_reference_ ? reference_.pressure_error : row_.pressure_error;
    if (!error || !(reference_.pressure > 0)) return std::nullopt;
    return *error / reference_.pressure;
  }

  void finished() {
    const bool fixed = row_.point.setting.kind == StudySetting::Kind::step;
    const std::string complaint =
        !row_.shape_error
            ? "nothing confirms it: " + (row_.reason.empty() ? reference_.text : row_.reason)
        : fixed ? complaint_with_fixed_steps()
                : complaint_with_error_control();
    if (!complaint.empty()) return end(verdicts::wrong, complaint);
    end(verdicts::agrees, reference_.error ? "" : "by one reference: " + reference_.text);
    const auto mark = [&](const std::string& text) {
      case_.reason += (case_.reason.empty() ? "" : "; ") + text;
    };
    if (!(case_.pressure_difference <= extremes::pressure))
      mark(fmt::format("a nodal pressure differs by {:.0f} % of the largest",
                       100 * *case_.pressure_difference));
    if (lost_wear()) mark("warned of lost wear");
  }

  /// Without wear there must be no difference.
  double relative(double error) const { return error == 0 ? 0 : error / reference_.wear; }

  /// A reference is compared with the other one.
  std::string complaint_with_error_control() {
    case_.bound = std::clamp(extremes::tolerances * row_.point.setting.value, extremes::finest,
                             extremes::coarsest);
    if (is_reference_ && !reference_.error) return "nothing confirms it: " + reference_.text;
    case_.difference = relative(is_reference_ ? *reference_.error : *row_.shape_error);
    const double own = relative(reference_.error.value_or(0));
    if (!(own <= *case_.bound)) return fmt::format("the references differ by {:.1e}", own);
    if (!(*case_.difference <= *case_.bound)) return "differs by more than the tolerance allows";
    return {};
  }

  /// No accuracy was requested: the error has to decrease with the step, or to be so small that the
  /// kinks of the solution hide this. A run that had to shorten its steps may have no fewer than
  /// with half the step.
  std::string complaint_with_fixed_steps() {
    case_.bound = extremes::no_answer;
    case_.difference = relative(*row_.shape_error);
    if (!(relative(reference_.error.value_or(0)) <= extremes::coarsest))
      return "the references differ";
    if (!(*case_.difference <= extremes::no_answer)) return "is nowhere near the solution";
    const RunRecord& half = row_.half;
    if (!row_.half_error) return "half the step does not confirm it: " + half.reason;
    const bool more_steps =
        !half.counters || !row_.counters || half.counters->steps > row_.counters->steps;
    const double enough = more_steps
                              ? std::max(extremes::shrinks * *case_.difference, extremes::near)
                              : extremes::coarsest;
    const double left = relative(*row_.half_error);
    if (left <= enough) return {};
    return fmt::format("half the step leaves {:.1e} of {:.1e}", left, *case_.difference);
  }

  ExtremeCase& case_;
  const StudyRow& row_;
  const StudyReference& reference_;
  const bool is_reference_;
  const RunFiles files_;
};

using CaseColumn = ColumnOf<ExtremeCase>;

CaseColumn column(const std::string& name, const std::string& meaning,
                  std::function<Cell(const ExtremeCase&)> value, const std::string& unit = "") {
  return {{name, unit, {}, "case", meaning}, std::move(value)};
}

std::vector<CaseColumn> case_columns() {
  using Case = const ExtremeCase&;
  return {
      column("study", "name of the study", [](Case c) { return c.study; }),
      column("sweep", "swept keys and their values", [](Case c) { return c.row.sweep; }),
      column("run", "method and setting", [](Case c) { return c.run.title; }),
      column("method", "name of the method in the study",
             [](Case c) { return c.row.point.method; }),
      column("integrator", "name of the integrator", [](Case c) { return c.row.point.integrator; }),
      column("rtol", "relative tolerance of a run with error control",
             [](Case c) {
               const StudySetting& setting = c.row.point.setting;
               return setting.kind == StudySetting::Kind::step ? Cell() : Cell(setting.value);
             }),
      column("file", "stem of its files in STUDY/runs", [](Case c) { return c.run.name; }),
      column("verdict", "how the case ended", [](Case c) { return c.verdict.name; }),
      column("difference",
             "shape error divided by the Euclidean norm of the wear of all contact nodes",
             [](Case c) { return maybe(c.difference); }),
      column("bound", "largest difference that agrees", [](Case c) { return maybe(c.bound); }),
      column("marked", "1 if the difference is less than ten times that between the references",
             [](Case c) { return int{c.row.marked_shape}; }),
      column("pressure_difference",
             "largest difference of a nodal pressure at the end, divided by the largest pressure; "
             "not judged",
             [](Case c) { return maybe(c.pressure_difference); }),
      column("steps", "accepted steps",
             [](Case c) { return c.row.counters ? Cell(c.row.counters->steps) : Cell(); }),
      column(
          "wall_seconds", "wall time of the integration",
          [](Case c) { return maybe(c.row.wall_seconds); }, "s"),
      column("reason", "why", [](Case c) { return c.reason; }),
  };
}

}  // namespace

std::vector<ExtremeCase> judge(const Study& study, const std::string& name,
                               const std::filesystem::path& folder) {
  const StudyTable table = measure(study, folder);
  std::vector<ExtremeCase> cases;
  for (const StudyRow& row : table.rows) {
    const StudyRun& run = study.runs[row.point.run];
    ExtremeCase& found = cases.emplace_back(ExtremeCase{.study = name, .run = run, .row = row});
    const auto& references = study.sweep[row.point.sweep].references;
    const bool is_reference = std::ranges::find(references, row.point.run) != references.end();
    Judgement(found, table.references[row.point.sweep], is_reference,
              files_of_run(folder, run.name))();
  }
  return cases;
}

std::string extremes_csv(const std::vector<ExtremeCase>& cases) {
  return csv_of(table_of(case_columns(), cases));
}

std::string extremes_json(const std::vector<ExtremeCase>& cases) {
  const Table table = table_of(case_columns(), cases);
  Json json = {{"gnomon", library_versions().at("gnomon")},
               {"verdicts", Json::array()},
               {"columns", columns_json(table)},
               {"rows", Json::array()}};
  for (const Verdict& verdict : verdicts::all)
    json["verdicts"].push_back(
        {{"name", verdict.name}, {"meaning", verdict.meaning}, {"fault", verdict.fault}});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Json marked = Json::array();
    if (cases[i].row.marked_shape && cases[i].difference) marked.push_back("difference");
    json["rows"].push_back({{"marked", marked}, {"values", values_json(table, i)}});
  }
  return json_text(json);
}

}  // namespace gnomon
