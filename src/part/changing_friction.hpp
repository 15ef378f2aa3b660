// Friction that changes with place, depth and time: friction.factor.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon::part {

Key friction_factor_key();

/// Whether the scene gives a factor that reads a variable.
bool reads_in_friction(const Scene& scene, const std::string& name);

/// By what the coefficients of friction are multiplied where contact may stick. `parts` are
/// complete but for it. Throws InputError.
template <int dim>
FrictionFactor read_friction_factor(const Scene& scene, const AssemblyParts<dim>& parts);

/// That a factor reads the depth of a slave that does not wear.
template <int dim>
void tell_of_unworn_friction(const Scene& scene, AssemblyParts<dim>& parts);

}  // namespace gnomon::part
