#include <algorithm>
#include <cmath>
#include <gnomon/integrators/stop_times.hpp>

namespace gnomon {

double end_of_fixed_step(double t, double step, double t_stop) {
  const double grid = step * (std::floor(t / step + shortest_remainder) + 1);
  return grid < t_stop - shortest_remainder * step ? grid : t_stop;
}

double end_of_smooth_part(const Structure& structure, double t, double t_stop) {
  const std::vector<double>& breakpoints = structure.breakpoints;
  const auto next = std::upper_bound(breakpoints.begin(), breakpoints.end(), t);
  return next == breakpoints.end() ? t_stop : std::min(*next, t_stop);
}

double end_at_stop(const Structure& structure, double t, double t_stop) {
  constexpr double beside = 1e-9;  // another end of a step
  const std::vector<double>& stops = structure.stops;
  const auto next = std::upper_bound(stops.begin(), stops.end(), t * (1 + beside));
  return next == stops.end() || *next >= t_stop * (1 - beside) ? t_stop : *next;
}

double inside_step(const Structure& structure, double from, double t) {
  return t > from && is_breakpoint(structure, t) ? std::nextafter(t, from) : t;
}

std::optional<Settling> next_settling(const Structure& structure,
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

bool is_breakpoint(const Structure& structure, double t) {
  return std::binary_search(structure.breakpoints.begin(), structure.breakpoints.end(), t);
}

}  // namespace gnomon
