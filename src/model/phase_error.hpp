// The error of the mean over the phases of a cycle, estimated with other phases.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <vector>

namespace gnomon {

/// The error of the means of speed, and of its products with force and load, over the phases:
/// against `fine` ones, as a part of the latter. Nothing is solved.
template <int dim>
double error_of_motion(const std::vector<Phase<dim>>& phases, const std::vector<Phase<dim>>& fine);

/// The number of phases, as many as the body has or more, that is within the tolerance at the
/// initial shape. Throws SolutionError.
template <int dim>
ChosenPhases choose_phases(std::shared_ptr<const Assembly<dim>> body, double tolerance);

}  // namespace gnomon
