// The error of the mean over the phases of a cycle on springs, estimated with other phases.
#pragma once

#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/model/model.hpp>
#include <optional>
#include <vector>

#include "winkler_system.hpp"

namespace gnomon::winkler {

/// The error of the means of speed and of its product with force or approach; nothing is solved.
double error_of_motion(const Foundation& foundation);

/// The error of the mean wear rate over the phases of the foundation at the wear depths d of a
/// time, as a part of the rate there, or of the mean rate until then if that is larger; absent
/// where nothing wears.
std::optional<PhaseError> phase_error(const Foundation& foundation, double t,
                                      const std::vector<double>& d);

/// The number of phases, as many as the foundation has or more, that is within the tolerance on the
/// unworn pin.
ChosenPhases choose_phases(const Foundation& foundation, double tolerance);

}  // namespace gnomon::winkler
