// The times at which a step has to end: the grid of fixed steps, breakpoints of the load, output
// times; and the limits at which a step, or a run, is given up. One definition for all drivers.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/system/system.hpp>
#include <optional>

namespace gnomon {

/// Largest number of Newton iterations for one step, or for 1e-5 of a run (run/guards.hpp).
/// It allows a dozen attempts with seven stages that use all 60 iterations of modified_newton each.
inline constexpr long most_newton_iterations = 5000;

/// No step is tried below this size [time]: a hundred times the rounding error of the time at the
/// end of the run.
inline double shortest_step(const IntegratorSettings& settings) {
  return 1e-14 * settings.end;
}

/// A step shorter than this part of the others is not made; the ends before and after it are
/// merged. The value is larger than all rounding errors of times, and too small to influence the
/// error of a step.
inline constexpr double shortest_remainder = 1e-3;

/// The next point after t of the grid k step, unless it is within shortest_remainder steps of t
/// (computed by counting, not by adding, so that it does not drift); or t_stop if it comes earlier,
/// or later by less than shortest_remainder steps.
inline double end_of_fixed_step(double t, double step, double t_stop) {
  const double grid = step * (std::floor(t / step + shortest_remainder) + 1);
  return grid < t_stop - shortest_remainder * step ? grid : t_stop;
}

/// The latest end of a step from t: the next breakpoint (Structure::breakpoints) before t_stop,
/// otherwise t_stop.
inline double end_of_smooth_part(const Structure& structure, double t, double t_stop) {
  const std::vector<double>& breakpoints = structure.breakpoints;
  const auto next = std::upper_bound(breakpoints.begin(), breakpoints.end(), t);
  return next == breakpoints.end() ? t_stop : std::min(*next, t_stop);
}

/// The same for Structure::stops, of steps that follow the error.
inline double end_at_stop(const Structure& structure, double t, double t_stop) {
  constexpr double beside = 1e-9;  // another end of a step
  const std::vector<double>& stops = structure.stops;
  const auto next = std::upper_bound(stops.begin(), stops.end(), t * (1 + beside));
  return next == stops.end() || *next >= t_stop * (1 - beside) ? t_stop : *next;
}

/// Whether F may have a kink in time at t, on which a step has ended.
inline bool is_breakpoint(const Structure& structure, double t) {
  return std::binary_search(structure.breakpoints.begin(), structure.breakpoints.end(), t);
}

/// A time of a step from `from`, or that just before it: loads that jump where the step ends are
/// those of the step.
inline double inside_step(const Structure& structure, double from, double t) {
  return t > from && is_breakpoint(structure, t) ? std::nextafter(t, from) : t;
}

/// The interval before a time of IntegratorSettings::settled in which pressures settle, by two
/// short steps of one size. In a stiff body an error of the shape far below its tolerance makes a
/// large error of the pressures: at nodes that have come into contact within a step, and by the
/// order of the stages (order reduction). Such an error decays within the time in which wear evens
/// out the pressures. The first short step is long beside that time, so that it removes the error,
/// and short beside the solution, so that its own is small; the second removes what the first has
/// left.
struct Settling {
  double begin, end;
  double middle() const { return (begin + end) / 2; }
  /// Times that differ by rounding are equal.
  bool before(double t) const { return t < begin - rounding(); }
  bool in_first_step(double t) const { return t < middle() - rounding(); }
  /// After two steps from t that were too long for the tolerance: where to begin with shorter ones,
  /// or the end if they would be too short to remove an error.
  double shorter(double t) const {
    constexpr double ratio = 4, shortest = 1.0 / 64;
    return end - t > shortest * (end - begin) ? end - (end - t) / ratio : end;
  }

private:
  double rounding() const { return 1e-9 * (end - begin); }
};

/// That before the next settled time after t. None with fixed steps, where it would be too short,
/// and where it would contain a breakpoint: the load must not change quickly in so long a step of
/// the first order.
inline std::optional<Settling> next_settling(const Structure& structure,
                                             const IntegratorSettings& settings, double t) {
  const std::vector<double>& settled = settings.settled;
  const auto next = std::upper_bound(settled.begin(), settled.end(), t);
  if (settings.step > 0 || next == settled.end()) return {};
  // Part of the time since the last one. The change of the rates, which slows down with time, is a
  // small part of them in so short a time; the error of a step of the first order, half the square
  // of its size, is then below the tolerance. An error estimate confirms it (OneStepStepper).
  const double part = std::min(1e-2, std::sqrt(settings.rtol));
  double size = part * (*next - (next == settled.begin() ? 0.0 : *std::prev(next)));
  if (settings.max_step > 0) size = std::min(size, settings.max_step / 2);  // both are one step
  constexpr double shortest = 1e-6;  // part of the run: below, a difference of d is only rounding
  if (size < shortest * settings.end) return {};
  const Settling settling{*next - 2 * size, *next};
  if (end_of_smooth_part(structure, settling.begin, settling.end) < settling.end) return {};
  return settling;
}

}  // namespace gnomon
