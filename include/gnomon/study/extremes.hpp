// Verdicts on the runs of a study, at the extremes of its parameters: every run is a case. A result
// is accepted when a run by another integrator confirms it. docs/extremes.md.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How a case ended.
struct Verdict {
  const char* name;     ///< "agrees"
  const char* meaning;  ///< a few words
  bool fault;           ///< of gnomon
};

namespace verdicts {
constexpr Verdict agrees = {
    "agrees", "finished, and another method confirms its worn surface as accurate enough", false};
constexpr Verdict refused = {"refused", "bad input, refused before the start", false};
constexpr Verdict stopped = {"stopped", "ended with a diagnosis, the last good state saved", false};
constexpr Verdict wrong = {
    "wrong", "finished with a shape that no reference confirms, or lost its last good state", true};
constexpr Verdict hung = {"hung", "killed after the longest time that a run may take", true};
constexpr Verdict crashed = {"crashed", "ended by a signal, or in another way than those above",
                             true};
constexpr Verdict all[] = {agrees, refused, stopped, wrong, hung, crashed};
}  // namespace verdicts

/// One row of the table of a suite of studies.
struct ExtremeCase {
  std::string study;  ///< "pin_on_flat-stiffness"
  StudyRun run;
  StudyRow row;
  Verdict verdict = verdicts::crashed;
  std::string reason{};                ///< given unless the case agrees with two references
  std::optional<double> difference{};  ///< shape error divided by the Euclidean norm of the wear
  std::optional<double> bound{};       ///< largest difference that agrees
  /// Largest of a node, divided by the largest pressure; not judged.
  std::optional<double> pressure_difference{};
};

/// Bounds of a difference that agrees.
namespace extremes {
constexpr double tolerances =
    100;  ///< in units of integrator.rtol, which bounds the error of one step
constexpr double finest = 1e-6;    ///< smallest bound, for smaller tolerances
constexpr double coarsest = 0.05;  ///< largest bound, for loose tolerances
constexpr double no_answer = 0.5;  ///< bound with fixed steps, which guarantee no accuracy
constexpr double shrinks = 0.8;    ///< half a fixed step has to reduce the difference to this part,
constexpr double near = 1e-3;      ///< or to less than this
constexpr double pressure = 0.05;  ///< not judged; a larger difference is reported
}  // namespace extremes

/// Judges the runs, in `folder`, of a study that keeps impossible ones (Impossible::kept). `name`:
/// that of the study in the suite.
std::vector<ExtremeCase> judge(const Study& study, const std::string& name,
                               const std::filesystem::path& folder);

/// The table as CSV; only the header if there are no cases.
std::string extremes_csv(const std::vector<ExtremeCase>& cases);
/// All that a page of the cases shows, as JSON: columns with units and meanings, verdicts, rows.
std::string extremes_json(const std::vector<ExtremeCase>& cases);

}  // namespace gnomon
