// The cases of an extreme study, and the verdicts on them.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/study/extremes.hpp>

#include "run/wear_integral.hpp"
#include "study/declaration.hpp"
#include "study/run_files.hpp"

namespace gnomon {

namespace {

using namespace study;
using Kind = StudySetting::Kind;

/// The same case with half its step, if the study does not have it already.
std::size_t halved_point(Study& study, std::size_t index) {
  StudyPoint half = study.points[index];
  half.setting.value /= 2;
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const StudyPoint& other = study.points[i];
    if (other.sweep == half.sweep && other.method == half.method &&
        other.setting.kind == Kind::step && other.setting.value == half.setting.value)
      return i;
  }
  const StudyRun& run = study.runs[half.run];
  StudyRun finer{run.name + "__half", run.title + " halved",
                 parse_scene(run.scene, study.file.string(),
                             {"integrator.step=" + number_text(half.setting.value)}, key_table)
                     .resolved()};
  half.run = study.runs.size();
  study.runs.push_back(std::move(finer));
  study.points.push_back(half);
  return study.points.size() - 1;
}

std::optional<double> error_control(const StudyPoint& point) {
  if (point.setting.kind == Kind::step) return std::nullopt;
  return point.setting.value;
}

/// The result of comparing a finished case with its references.
struct Judgement {
  Verdict verdict = Verdict::wrong;
  std::string reason{};
  std::optional<double> difference{}, bound{};
};

class Judge {
public:
  Judge(const ExtremeStudy& extreme, const std::filesystem::path& folder)
      : extreme_(extreme), folder_(folder), table_(measure(extreme.study, folder)) {}

  Judgement operator()(std::size_t index) const {
    const StudyRow& row = table_.rows[index];
    if (!row.end) return {Verdict::crashed, row.reason};
    if (row.end->timed_out) return {Verdict::hung, row.reason};
    if (row.end->signal != 0) return {Verdict::crashed, row.reason};
    switch (row.end->exit_code) {
      case 0:
        return finished(index);
      case 2:
        return refused(row);
      case 3:
        return stopped(row);
      default:
        return {Verdict::crashed, row.reason};
    }
  }

  const StudyRow& row(std::size_t index) const { return table_.rows[index]; }

  /// None if there is no pressure.
  std::optional<double> pressure_difference(std::size_t index) const {
    const StudyRow& row = table_.rows[index];
    const StudyReference& reference = table_.references[row.point.sweep];
    const auto error = is_reference(row) ? reference.pressure_error : row.pressure_error;
    if (!error || !(reference.pressure > 0)) return std::nullopt;
    return *error / reference.pressure;
  }

private:
  RunFiles files(const StudyRow& row) const {
    return {folder_, extreme_.study.runs[row.point.run].name};
  }

  Judgement refused(const StudyRow& row) const {
    if (std::filesystem::exists(files(row).result))
      return {Verdict::wrong, "refused, but wrote a result: " + row.reason};
    return {Verdict::refused, row.reason};
  }

  Judgement stopped(const StudyRow& row) const {
    if (row.reason.empty()) return {Verdict::wrong, "stopped without a diagnosis"};
    if (!holds_last_state(row)) return {Verdict::wrong, "lost the last good state: " + row.reason};
    return {Verdict::stopped, row.reason};
  }

  bool holds_last_state(const StudyRow& row) const try {
    if (!row.reached) return !std::filesystem::exists(files(row).result);  // stopped at the start
    const ResultReader result(files(row).result);
    const std::vector<double> stored = result.stored_times();
    return !stored.empty() && stored.back() == *row.reached;
  } catch (const Error&) {
    return false;
  }

  /// The references have this error too, so that they agree in spite of it.
  bool lost_wear(const StudyRow& row) const try {
    const ResultReader result(files(row).result);
    const Observation last = observation_of(result.history().back().scalars);
    return has_lost_wear(last, invisible_volume(result.grid(), last.dim));
  } catch (const Error&) {
    return false;
  }

  Judgement finished(std::size_t index) const {
    Judgement judgement = confirmed(index);
    if (judgement.verdict != Verdict::agrees) return judgement;
    const auto mark = [&judgement](const std::string& text) {
      judgement.reason += (judgement.reason.empty() ? "" : "; ") + text;
    };
    if (const auto pressure = pressure_difference(index); !(pressure <= extremes::pressure))
      mark(fmt::format("a nodal pressure differs by {:.0f} % of the largest", 100 * *pressure));
    if (lost_wear(row(index))) mark("warned of lost wear");
    return judgement;
  }

  Judgement confirmed(std::size_t index) const {
    const StudyRow& row = table_.rows[index];
    const StudyReference& reference = table_.references[row.point.sweep];
    if (!row.shape_error)
      return {Verdict::wrong,
              "nothing confirms it: " + (row.reason.empty() ? reference.text : row.reason)};
    const bool fixed = row.point.setting.kind == Kind::step;
    return fixed ? with_fixed_steps(index, reference) : with_error_control(row, reference);
  }

  /// Without wear there must be no difference.
  static double relative(double error, const StudyReference& reference) {
    return error == 0 ? 0 : error / reference.wear;
  }

  static std::string lone(const StudyReference& reference) {
    return reference.error ? "" : "by one reference: " + reference.text;
  }

  bool is_reference(const StudyRow& row) const {
    const auto& runs = extreme_.study.sweep[row.point.sweep].references;
    return std::ranges::find(runs, row.point.run) != runs.end();
  }

  /// A reference is compared with the other one.
  std::optional<double> difference(const StudyRow& row, const StudyReference& reference) const {
    const bool confirms = is_reference(row);
    if (confirms && !reference.error) return std::nullopt;
    return relative(confirms ? *reference.error : *row.shape_error, reference);
  }

  Judgement with_error_control(const StudyRow& row, const StudyReference& reference) const {
    Judgement result;
    result.bound = std::clamp(extremes::tolerances * row.point.setting.value, extremes::finest,
                              extremes::coarsest);
    result.difference = difference(row, reference);
    const double own = relative(reference.error.value_or(0), reference);
    if (!result.difference)
      result.reason = "nothing confirms it: " + reference.text;
    else if (!(own <= *result.bound))
      result.reason = fmt::format("the references differ by {:.1e}", own);
    else if (!(*result.difference <= *result.bound))
      result.reason = "differs by more than the tolerance allows";
    else
      result = {Verdict::agrees, lone(reference), result.difference, result.bound};
    return result;
  }

  /// A run that had to shorten its steps may have no fewer than with half the step.
  static bool has_more_steps(const StudyRow& half, const StudyRow& row) {
    return !half.counters || !row.counters || half.counters->steps > row.counters->steps;
  }

  /// No accuracy was requested: the error has to decrease with the step, or to be so small that the
  /// kinks of the solution hide this.
  Judgement with_fixed_steps(std::size_t index, const StudyReference& reference) const {
    const StudyRow& row = table_.rows[index];
    const StudyRow& half = table_.rows[*extreme_.halved[index]];
    Judgement result;
    result.bound = extremes::no_answer;
    result.difference = relative(*row.shape_error, reference);
    if (!(relative(reference.error.value_or(0), reference) <= extremes::coarsest)) {
      result.reason = "the references differ";
    } else if (!(*result.difference <= extremes::no_answer)) {
      result.reason = "is nowhere near the solution";
    } else if (!half.shape_error) {
      result.reason = "half the step does not confirm it: " + half.reason;
    } else {
      const double left = relative(*half.shape_error, reference);
      const double enough = has_more_steps(half, row)
                                ? std::max(extremes::shrinks * *result.difference, extremes::near)
                                : extremes::coarsest;
      if (left <= enough)
        result = {Verdict::agrees, lone(reference), result.difference, result.bound};
      else
        result.reason =
            fmt::format("half the step leaves {:.1e} of {:.1e}", left, *result.difference);
    }
    return result;
  }

  const ExtremeStudy& extreme_;
  const std::filesystem::path folder_;
  const StudyTable table_;
};

}  // namespace

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::refused:
      return "refused";
    case Verdict::stopped:
      return "stopped";
    case Verdict::wrong:
      return "wrong";
    case Verdict::hung:
      return "hung";
    case Verdict::crashed:
      return "crashed";
  }
  return {};
}

bool is_fault(Verdict verdict) {
  return verdict == Verdict::wrong || verdict == Verdict::hung || verdict == Verdict::crashed;
}

ExtremeStudy load_extreme_study(const std::filesystem::path& file) {
  ExtremeStudy extreme;
  extreme.study = load_study(file, Impossible::kept);
  Study& study = extreme.study;
  extreme.cases = study.points.size();
  extreme.halved.resize(extreme.cases);
  for (std::size_t i = 0; i < extreme.cases; ++i)
    if (study.points[i].setting.kind == Kind::step &&
        study.runs[study.points[i].run].overrides.empty())
      extreme.halved[i] = halved_point(study, i);
  return extreme;
}

std::vector<ExtremeCase> judge(const ExtremeStudy& extreme, const std::string& name,
                               const std::filesystem::path& folder) {
  const Judge judge(extreme, folder);
  std::vector<ExtremeCase> cases;
  for (std::size_t i = 0; i < extreme.cases; ++i) {
    const StudyRow& row = judge.row(i);
    const StudyRun& run = extreme.study.runs[row.point.run];
    Judgement judgement = judge(i);
    cases.push_back({.study = name,
                     .sweep = row.sweep,
                     .run = run.title,
                     .method = row.point.method,
                     .integrator = row.point.integrator,
                     .rtol = error_control(row.point),
                     .file = run.name,
                     .verdict = judgement.verdict,
                     .reason = std::move(judgement.reason),
                     .difference = judgement.difference,
                     .bound = judgement.bound,
                     .pressure_difference = judge.pressure_difference(i),
                     .marked = row.marked_shape,
                     .counters = row.counters,
                     .wall_seconds = row.wall_seconds});
  }
  return cases;
}

}  // namespace gnomon
