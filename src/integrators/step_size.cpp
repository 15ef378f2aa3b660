#include <algorithm>
#include <cmath>
#include <gnomon/integrators/step_size.hpp>

namespace gnomon {

namespace {
constexpr double safety = 0.9;
constexpr double most_growth = 5, most_shrink = 0.2;
constexpr double least_error = 1e-8;  // a vanishing estimate says nothing more
}  // namespace

double StepSizeControl::after_success(double h, double error) {
  error = std::max(error, least_error);
  const double factor =
      safety * std::pow(error, -0.7 * exponent_) * std::pow(last_error_, 0.4 * exponent_);
  last_error_ = error;
  const double bound = may_grow_ ? most_growth : 1.0;
  may_grow_ = true;
  return h * std::clamp(factor, most_shrink, bound);
}

double StepSizeControl::after_rejection(double h, double error) {
  may_grow_ = false;
  return h * std::clamp(safety * std::pow(error, -exponent_), most_shrink, 0.9);
}

double StepSizeControl::after_failure(double h) {
  may_grow_ = false;
  return h / 2;
}

double end_of_fixed_step(double t, double step, double t_stop) {
  const double grid = step * (std::floor(t / step + sliver) + 1);
  return grid < t_stop - sliver * step ? grid : t_stop;
}

double end_of_smooth_part(const Structure& structure, double t, double t_stop) {
  const std::vector<double>& corners = structure.corners;
  const auto next = std::upper_bound(corners.begin(), corners.end(), t);
  return next == corners.end() ? t_stop : std::min(*next, t_stop);
}

bool is_corner(const Structure& structure, double t) {
  return std::binary_search(structure.corners.begin(), structure.corners.end(), t);
}

double first_step(const State& start, const Structure& structure,
                  const IntegratorSettings& settings, int order) {
  double largest = 0;
  for (std::size_t i = 0; i < start.ydot.size(); ++i)
    if (structure.differential[i]) largest = std::max(largest, std::abs(start.ydot[i]));
  const double longest = settings.end - start.t;
  if (largest == 0) return longest / 100;
  const double part = std::pow(settings.rtol, 1.0 / (order + 1));
  return std::min(longest, part * settings.scale / largest);
}

}  // namespace gnomon
