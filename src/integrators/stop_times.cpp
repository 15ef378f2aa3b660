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

SettlingStop settling_stop(const IntegratorSettings& settings, double t, double t_stop) {
  const std::vector<double>& settled = settings.settled;
  const auto next = std::upper_bound(settled.begin(), settled.end(), t);
  if (settings.step > 0 || next == settled.end()) return {t_stop, false};
  // Part of the time since the last one. The error of a step of the first order is half the square
  // of its size: below the tolerance of a step by a factor of twenty.
  const double part = std::min(1e-2, std::sqrt(settings.rtol / 10));
  const double size = part * (*next - (next == settled.begin() ? 0.0 : *std::prev(next)));
  constexpr double shortest = 1e-6;  // part of the run: below, a difference of d is only rounding
  if (size < shortest * settings.end) return {t_stop, false};
  const double begin = *next - 2 * size, middle = *next - size, nothing = 1e-9 * size;
  if (t < begin - nothing) return {std::min(begin, t_stop), false};
  return {std::min(t < middle - nothing ? middle : *next, t_stop), true};
}

bool is_breakpoint(const Structure& structure, double t) {
  return std::binary_search(structure.breakpoints.begin(), structure.breakpoints.end(), t);
}

}  // namespace gnomon
