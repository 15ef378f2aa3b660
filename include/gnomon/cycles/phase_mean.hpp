// Means over the phases of a cycle: their error, and the number of phases that it asks for
// (docs/cycles.md, "Error of the mean").
#pragma once

#include <cmath>
#include <functional>
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace gnomon {

/// Phases of a cycle, a power of two times as many as a model has.
struct PhaseSet {
  enum class Kind {
    own,         ///< as the model would have them
    comparison,  ///< that `own` is compared with (CycleQuadrature::comparison)
    fine         ///< thousands, for the means of motion and load alone
  };
  Kind kind = Kind::own;
  int times = 1;
};

/// The phases of a set, made by `phase_at` of the points of a quadrature. Where a point stands for
/// an interval, `stand_for(phases of the interval, phase)` gives it what they have in the mean.
template <class PhaseAt, class StandFor>
auto phases_of(const CycleQuadrature& quadrature, const PhaseSet& set, const PhaseAt& phase_at,
               const StandFor& stand_for) {
  const auto phases_at = [&](const std::vector<CyclePoint>& points) {
    std::vector<std::invoke_result_t<PhaseAt, const CyclePoint&>> phases;
    for (const CyclePoint& point : points) phases.push_back(phase_at(point));
    return phases;
  };
  const CycleQuadrature finer = quadrature.refined(set.times);
  if (set.kind == PhaseSet::Kind::fine) return phases_at(finer.fine_points());
  const CycleQuadrature chosen = set.kind == PhaseSet::Kind::own ? finer : finer.comparison();
  auto phases = phases_at(chosen.points());
  if (!chosen.stands_for_intervals()) return phases;
  const std::vector<std::vector<CyclePoint>> intervals = chosen.intervals();
  for (std::size_t p = 0; p < phases.size(); ++p) stand_for(phases_at(intervals[p]), phases[p]);
  return phases;
}

/// The mean of a function of a phase; a phase has a `weight`.
template <class Phase, class Function>
double mean_over(const std::vector<Phase>& phases, const Function& f) {
  double sum = 0;
  for (const Phase& phase : phases) sum += phase.weight * f(phase);
  return sum;
}

/// The error of such a mean against that over `fine` phases, as a part of the mean magnitude there;
/// 0 where the function vanishes.
template <class Phase, class Function>
double error_of_mean(const std::vector<Phase>& phases, const std::vector<Phase>& fine,
                     const Function& f) {
  const double size = mean_over(fine, [&](const Phase& phase) { return std::abs(f(phase)); });
  return size > 0 ? std::abs(mean_over(phases, f) - mean_over(fine, f)) / size : 0;
}

/// What cycle.phases = "auto" comes to.
struct ChosenPhases {
  long count = 0;
  double error = 0;  ///< of the mean over them; infinite: not known, there are as many as are tried
};

inline constexpr long fewest_chosen_phases = 4, most_chosen_phases = 256;

/// As many phases as `count(times)` says of times = 1, 2, 4, ..., until the `error(times)` of the
/// mean over them is within the tolerance, or until there are most_chosen_phases.
ChosenPhases choose_phases(double tolerance, const std::function<long(int times)>& count,
                           const std::function<double(int times)>& error);

/// "1 phase", "16 phases".
std::string phases_text(long count);
/// For the user: how many, and why.
std::string remark_on_choice(const ChosenPhases& chosen, double tolerance);
/// For the user: that the mean of speed or force over so many phases has an error; `parts` of the
/// cycle between corners and reversals. Empty where it is within the tolerance.
std::string remark_on_motion(double error, double tolerance, long phases, int parts);

}  // namespace gnomon
