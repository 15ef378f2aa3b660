// Equilibrium of a worn body at frozen shape, from rest.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>

#include "model/load_ramp.hpp"

namespace gnomon {

/// How the load of this body is best applied. What limits an increment from rest is the change of
/// volume that a linear step makes at second order in the strain: against it stands lambda, against
/// the strain mu. So the first increment brings a mean strain (pressure by Young's modulus) of a
/// few times mu / lambda, or the whole load where that is less. Measured on the pin (E = 10 and 20
/// MPa, nu = 0.499, 20x20): twice as much fails.
template <int dim>
RampOptions ramp_options(const WornBody<dim>& body);

/// Brings `values` (zero displacement) into equilibrium with the whole load at t = 0 by a ramp.
/// Increments below the whole load are solved only roughly, for they are mere guesses. `contact`:
/// the system of WornBodyEquations::deformation(); its load fraction is left where the ramp ended.
template <int dim>
RampReport find_equilibrium(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& contact,
                            const RampOptions& options, FieldValues<dim>& values,
                            Counters& counters);

}  // namespace gnomon
