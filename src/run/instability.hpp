// Ends runs whose fixed steps amplify the fastest mode, or hardly damp it: they would finish like
// any other, with numbers that are worthless.
#pragma once

#include <gnomon/integrator.hpp>
#include <gnomon/model.hpp>

namespace gnomon {

/// Whether fixed steps of the method can be too long for stiff modes: explicit methods, and those
/// with |R| near one or above at infinity.
bool may_fail_to_damp(const Integrator& integrator, const IntegratorSettings& settings);

/// Throws SolutionError when a step doubles the fastest mode at this state, or when more than half
/// of it is left at the end of the run though it should have decayed. Says nothing where the
/// spectrum cannot be computed. Needs may_fail_to_damp().
void require_damping(const Model& model, const Integrator& integrator,
                     const IntegratorSettings& settings, const State& state);

/// Throws SolutionError when nodes flicker (run/flicker.hpp).
void require_no_flicker(long flickering_nodes, const Integrator& integrator);

}  // namespace gnomon
