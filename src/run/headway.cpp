#include "run/headway.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/integrators/step_size.hpp>

namespace gnomon {

Headway::Headway(double t, const Counters& counters, double end)
    : t_(t), newton_iterations_(counters.newton_iterations), end_(end) {}

void Headway::require(double t, const Counters& counters) {
  constexpr double least = 1e-5;
  if (counters.newton_iterations - newton_iterations_ < most_newton_iterations) return;
  if (t - t_ < least * end_)
    throw SolutionError(
        fmt::format("no headway: the last {} Newton iterations went from t = {:.9g} s to {:.9g} s",
                    counters.newton_iterations - newton_iterations_, t_, t));
  *this = Headway(t, counters, end_);
}

}  // namespace gnomon
