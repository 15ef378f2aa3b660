#include "run/progress_watch.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stop_rules.hpp>

namespace gnomon {

ProgressWatch::ProgressWatch(double t, const Counters& counters, double end)
    : t_(t), newton_iterations_(counters.newton_iterations), end_(end) {}

void ProgressWatch::require(double t, const Counters& counters) {
  constexpr double least_progress = 1e-5;  // part of the length of the run
  const long iterations = counters.newton_iterations - newton_iterations_;
  if (iterations < most_newton_iterations) return;
  if (t - t_ < least_progress * end_)
    throw SolutionError(fmt::format(
        "lack of progress: the last {} Newton iterations went from t = {:.9g} s to {:.9g} s",
        iterations, t_, t));
  *this = ProgressWatch(t, counters, end_);
}

}  // namespace gnomon
