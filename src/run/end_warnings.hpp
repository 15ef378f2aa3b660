// Warnings about the numbers of a run: why they may be worthless, or less accurate than asked for.
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

/// Warns of an error of the mean over the phases of a cycle at the start that is larger than the
/// tolerance: about as large may that of the worn shape be; empty otherwise. At the end the shape
/// has the traces of the phases, so that the error of the mean there is several times that of the
/// shape.
std::string phase_warning(const PhaseError& at_start, double tolerance);

}  // namespace gnomon
