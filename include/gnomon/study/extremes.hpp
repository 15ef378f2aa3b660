// Studies at the extremes of their parameters: every run is a case with a verdict. A result is
// accepted when a run by another integrator confirms it. docs/extremes.md.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How a case ended. The last three are faults of gnomon.
enum class Verdict {
  agrees,   ///< finished, and confirmed with the required accuracy
  refused,  ///< exit code 2, nothing written
  stopped,  ///< exit code 3 with a diagnosis, the last good state saved
  wrong,    ///< finished with an unconfirmed result, or lost its last good state
  hung,     ///< killed at the limit
  crashed   ///< ended by a signal or in another way than those above
};

/// "agrees", ...
std::string verdict_name(Verdict verdict);
bool is_fault(Verdict verdict);

/// A study that keeps impossible runs, and in which every run with a fixed step is also done with
/// half the step.
struct ExtremeStudy {
  Study study;
  std::size_t cases = 0;  ///< number of points that are cases; later points only confirm others
  std::vector<std::optional<std::size_t>> halved;  ///< per case: the point with half its step
};

/// Throws InputError as load_study() does.
ExtremeStudy load_extreme_study(const std::filesystem::path& file);

/// One row of the suite's table.
struct ExtremeCase {
  std::string study;  ///< "pin_on_flat-stiffness"
  std::string sweep;
  std::string run;  ///< "bdf rtol 1e-09"
  std::string method, integrator;
  std::optional<double> rtol;  ///< of a run with error control
  std::string file;            ///< stem of its files in STUDY/runs
  Verdict verdict = Verdict::crashed;
  std::string reason;                ///< given unless the case agrees with two references
  std::optional<double> difference;  ///< shape error divided by the Euclidean norm of the wear
  std::optional<double> bound;       ///< largest difference that agrees
  std::optional<double>
      pressure_difference;  ///< largest of a node, divided by the largest pressure; not judged
  bool marked = false;      ///< less than ten times the reference's own error
  std::optional<Counters> counters;
  std::optional<double> wall_seconds;
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

/// Judges the runs of a study in its folder.
std::vector<ExtremeCase> judge(const ExtremeStudy& study, const std::string& name,
                               const std::filesystem::path& folder);

/// The table as CSV; only the header if there are no cases.
std::string extremes_csv(const std::vector<ExtremeCase>& cases);
/// All that a page of the cases shows, as JSON: columns with units and meanings, verdicts, rows.
std::string extremes_json(const std::vector<ExtremeCase>& cases);

}  // namespace gnomon
