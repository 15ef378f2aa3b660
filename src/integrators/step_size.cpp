#include <algorithm>
#include <cmath>
#include <gnomon/integrators/step_size.hpp>
#include <gnomon/system/system.hpp>

namespace gnomon {

namespace {
// Aims at nine tenths of the step that the estimate allows, so that few are rejected.
constexpr double safety = 0.9;
// Gustafsson's gains: 0.7 and 0.4 of the exponent of the elementary (I) controller.
constexpr double proportional = 0.7, integral = 0.4;
// An estimate holds for steps of similar size: beyond these factors the error law is unreliable.
constexpr double most_shrink = 0.2;
constexpr double least_error = 1e-8;  // smaller estimates give no more information
}  // namespace

double StepSizeControl::after_success(double h, double error) {
  error = std::max(error, least_error);
  const double factor = safety * std::pow(error, -proportional * exponent_) *
                        std::pow(last_error_, integral * exponent_);
  last_error_ = error;
  const double bound = may_grow_ ? most_growth : 1.0;
  may_grow_ = true;
  return h * std::clamp(factor, most_shrink, bound);
}

double StepSizeControl::after_rejection(double h, double error) {
  may_grow_ = false;
  return h * std::max(safety * std::pow(error, -exponent_), most_shrink);
}

double StepSizeControl::after_failure(double h) {
  may_grow_ = false;
  return h / 2;
}

double first_step(const State& start, const Structure& structure,
                  const IntegratorSettings& settings, int order) {
  constexpr double parts = 100;  // parts of the remaining run, if nothing moves yet
  double largest = 0;
  for (std::size_t i = 0; i < start.ydot.size(); ++i)
    if (structure.differential[i]) largest = std::max(largest, std::abs(start.ydot[i]));
  const double longest = settings.end - start.t;
  if (largest == 0) return longest / parts;
  const double part = std::pow(settings.rtol, 1.0 / (order + 1));
  return std::min(longest, part * settings.scale / largest);
}

}  // namespace gnomon
