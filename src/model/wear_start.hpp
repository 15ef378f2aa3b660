// Equilibrium of a worn body at frozen shape, computed from the unloaded state.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>

#include "model/load_ramp.hpp"

namespace gnomon {

/// The best increments of the load of this body. An increment from rest is limited by the change of
/// volume that a linear step causes at second order in the strain: lambda resists this change, mu
/// resists the strain. So the first increment causes a mean strain (pressure divided by Young's
/// modulus) of a few times mu / lambda, or is the whole load if that is less.
/// Measured on the pin (E = 10 and 20
/// MPa, nu = 0.499, 20x20): twice as much fails.
template <int dim>
RampOptions ramp_options(const Assembly<dim>& body);

/// Brings `values` (zero displacement; any shape) into equilibrium with the whole load, at t = 0 or
/// the time at which `contact` is frozen with the shape, by a ramp.
/// Increments below the whole load are solved only roughly, because they only give first guesses.
/// `contact`: the system of WornBodyEquations::deformation(); its load fraction keeps the value at
/// which the ramp ended.
template <int dim>
RampReport find_equilibrium(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& contact,
                            const RampOptions& options, FieldValues<dim>& values,
                            Counters& counters);

}  // namespace gnomon
