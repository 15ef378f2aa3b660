// Warnings at the end of a run that has finished but whose numbers are worthless.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Warns of an explicit method above its critical step, and of wear that is missing in the shape by
/// more than `invisible` (wear_integral.hpp).
std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator);

/// Warns of an error of the mean over the phases of a cycle at the end that is larger than the
/// tolerance; empty otherwise.
std::string phase_warning(const std::vector<PhaseError>& errors, double tolerance);

}  // namespace gnomon
