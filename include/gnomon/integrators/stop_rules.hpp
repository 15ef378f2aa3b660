// When a step, or a run, is given up. One definition for all drivers.
#pragma once

#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

/// Newton iterations that are spent on one step, or on 1e-5 of a run (run/progress_watch.hpp),
/// before it is given up. That is a dozen attempts at seven stages that use up the 60 iterations of
/// modified_newton each.
inline constexpr long most_newton_iterations = 5000;

/// No step is tried below this size [time]: a hundred roundings of the time at the end of the run.
inline double shortest_step(const IntegratorSettings& settings) {
  return 1e-14 * settings.end;
}

}  // namespace gnomon
