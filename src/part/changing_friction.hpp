// Friction that changes with place, depth and time: friction.factor.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

Key friction_factor_key();

/// By what the coefficients of friction are multiplied where contact may stick. `parts` are
/// complete but for it. Throws InputError.
template <int dim>
FrictionFactor read_friction_factor(const Scene& scene, const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
