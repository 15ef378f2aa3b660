// The limits at which a step, or a run, is ended. One definition for all drivers.
#pragma once

#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

/// Largest number of Newton iterations for one step, or for 1e-5 of a run (run/guards.hpp).
/// It allows a dozen attempts with seven stages that use all 60 iterations of modified_newton each.
inline constexpr long most_newton_iterations = 5000;

/// No step is tried below this size [time]: a hundred times the rounding error of the time at the
/// end of the run.
inline double shortest_step(const IntegratorSettings& settings) {
  return 1e-14 * settings.end;
}

}  // namespace gnomon
