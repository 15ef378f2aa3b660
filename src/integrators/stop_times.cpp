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

bool is_breakpoint(const Structure& structure, double t) {
  return std::binary_search(structure.breakpoints.begin(), structure.breakpoints.end(), t);
}

}  // namespace gnomon
