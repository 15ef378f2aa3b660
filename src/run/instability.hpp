// Ends runs of explicit methods whose steps exceed the critical one: they would finish like any
// other, with numbers that are worthless.
#pragma once

#include <gnomon/integrator.hpp>
#include <gnomon/model.hpp>

namespace gnomon {

/// Whether the method is stable for short steps only.
bool is_conditionally_stable(const Integrator& integrator, const IntegratorSettings& settings);

/// Throws SolutionError when the fixed step exceeds the critical one at this state by half or more,
/// so that the fastest mode doubles in a step. Slower growth is seen when nodes flicker. Says
/// nothing where the critical step cannot be computed.
void require_stable_step(const Model& model, const Integrator& integrator,
                         const IntegratorSettings& settings, const State& state);

/// Throws SolutionError when nodes flicker (run/flicker.hpp).
void require_no_flicker(long flickering_nodes, const Integrator& integrator);

}  // namespace gnomon
