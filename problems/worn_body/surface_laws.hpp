// Wear laws of surfaces that have their own: wear.surfaces.NAME.rate.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// Sets the laws and who wears by which. A node of two surfaces wears by the law of the one named
/// first in wear.on. Throws InputError.
template <int dim>
void read_wear_laws(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body);

/// Checks the laws of surfaces for the values that a run may meet, like that of wear.rate. To be
/// called when scales are known. Throws InputError.
template <int dim>
void require_surface_laws(const Scene& scene, const WornBody<dim>& body);

}  // namespace gnomon::part
