// What the end of a run tells of its numbers: it finishes like any other, and they are worthless.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/observation.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Of an explicit method above its critical step, and of wear that the shape has not lost.
std::vector<std::string> end_warnings(const Observation& last, long chattering_nodes,
                                      const Integrator& integrator);

}  // namespace gnomon
