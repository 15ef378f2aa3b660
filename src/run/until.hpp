// The end of a run before time.end: where an observation passes a value.
#pragma once

#include <gnomon/model/observation.hpp>
#include <gnomon/run/run.hpp>

namespace gnomon {

/// Negative before the end, in the unit of the observation. Throws InputError if there is no such
/// observation.
double excess(const Until& until, const Observation& observed);

/// Of an observation that changes evenly from `before` (negative) to `after`: the part of the
/// step at which the run ends, or 1 if the step ends there or shortly behind.
double part_until(double before, double after);

}  // namespace gnomon
