// Explicit Runge-Kutta methods on the reduced ODE, by ARKODE's ERKStep.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <memory>

namespace gnomon {

/// By an explicit table with an embedded method. Error control by ARKODE's PI controller in the
/// norm of ErrorNorm; or fixed steps, halved when a solve fails.
std::unique_ptr<Stepper> make_erk(const System& system, const IntegratorSettings& settings,
                                  Counters& counters, ButcherTable table);

}  // namespace gnomon
