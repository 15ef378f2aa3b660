// Studies at the extremes of their parameters: every run is a case with a verdict. An answer is
// believed when a differently integrated run confirms it. docs/extremes.md.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How a case ended. The last three are faults of gnomon.
enum class Verdict {
  agrees,   ///< finished, and confirmed to the accuracy that was asked for
  refused,  ///< exit code 2, nothing written
  stopped,  ///< exit code 3 with a diagnosis, the last good state saved
  wrong,    ///< finished with something that nothing confirms, or lost what it had
  hung,     ///< killed at the limit
  crashed   ///< ended by a signal or in a way that is none of the above
};

/// "agrees", ...
std::string verdict_name(Verdict verdict);
bool is_fault(Verdict verdict);

/// A study whose impossible runs are kept, and in which every fixed step is run with half of it,
/// too.
struct ExtremeStudy {
  Study study;
  std::size_t cases = 0;  ///< the first points; those behind them are only to confirm others
  std::vector<std::optional<std::size_t>> halved;  ///< a case: the point with half its step
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
  std::string reason;                ///< of all that do not agree, or by one reference only
  std::optional<double> difference;  ///< shape error by the Euclidean norm of the wear
  std::optional<double> bound;       ///< up to which that agrees
  std::optional<double>
      pressure_difference;  ///< largest of a node, by the largest pressure; not judged
  bool marked = false;      ///< less than ten times the reference's own error
  std::optional<Counters> counters;
  std::optional<double> wall_seconds;
};

/// Bounds of the difference that agrees.
namespace extremes {
constexpr double tolerances = 100;  ///< of integrator.rtol, which bounds the error of one step
constexpr double finest = 1e-6;     ///< what is confirmed of smaller tolerances
constexpr double coarsest = 0.05;   ///< what is asked of the loosest tolerances
constexpr double no_answer = 0.5;   ///< with fixed steps, which promise nothing: beyond it is none
constexpr double shrinks = 0.8;     ///< by which half a fixed step has to reduce the difference,
constexpr double near = 1e-3;       ///< or leave no more than this
constexpr double pressure = 0.05;   ///< not judged; a larger difference is told
}  // namespace extremes

/// Judges the runs of a study in its folder.
std::vector<ExtremeCase> judge(const ExtremeStudy& study, const std::string& name,
                               const std::filesystem::path& folder);

/// The table as CSV; a header alone for no cases.
std::string extremes_csv(const std::vector<ExtremeCase>& cases);
/// The table as a self-contained page; the runs are in folders beside it. `figures`: texts of SVG
/// files; `note` stands in for them when there are none.
std::string extremes_page(const std::vector<ExtremeCase>& cases,
                          const std::vector<std::string>& figures, const std::string& note);

}  // namespace gnomon
