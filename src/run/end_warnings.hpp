// Warnings at the end of a run that has finished but whose numbers are worthless.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/observation.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Warns of an explicit method above its critical step, and of wear that is missing in the shape by
/// more than `invisible` (wear_integral.hpp).
std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator);

}  // namespace gnomon
