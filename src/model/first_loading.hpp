// The way of the first loading of a path, where friction may stick: what of the forces acts on it.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon {

/// A phase in which parts of its forces act.
template <int dim>
Phase<dim> with_parts(Phase<dim> phase, const LoadingStep& parts);

/// From one step, at part 0, to the next one, at part 1.
LoadingStep between(const LoadingStep& from, const LoadingStep& to, double part);

/// Before anything else pushes the bodies, something has to press them: where other forces grow
/// with what presses, they do so from a small part of it on, in increments.
std::vector<LoadingStep> with_a_pressed_start(std::vector<LoadingStep> steps);

}  // namespace gnomon
