// Where a step has to end: on the grid of fixed steps, on breakpoints of the load, on times to
// store.
#pragma once

#include <gnomon/system/system.hpp>

namespace gnomon {

/// Steps that are shorter by this factor than the others are not made: their ends merge. Wide
/// enough for any rounding of times, and too narrow to be seen in the error of a step.
inline constexpr double sliver = 1e-3;

/// The next point after t of the grid k step that is not within a sliver of t (by count rather than
/// by adding up, so that it does not drift), or t_stop where that comes earlier or a sliver later.
double end_of_fixed_step(double t, double step, double t_stop);

/// Where a step from t has to end at the latest: on the next breakpoint (Structure::breakpoints)
/// before t_stop, else on t_stop.
double end_of_smooth_part(const Structure& structure, double t, double t_stop);
/// Whether F may have a kink in time at t, on which a step has ended.
bool is_breakpoint(const Structure& structure, double t);

}  // namespace gnomon
