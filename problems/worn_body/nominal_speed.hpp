// The speed at which a counter-body slides, for the sliding distance s and typical magnitudes.
#pragma once

#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

#include "part_cycle.hpp"

namespace gnomon::part {

/// The scene with `wear.velocity`, unless it has one: the speed at which the counter-body's surface
/// slides where it first touches, its mean over the cycle. Sets it in the body, and the place in
/// the body's motion. Throws InputError where they do not meet.
template <int dim>
Scene with_speed(const Scene& scene, const std::optional<PartCycle<dim>>& cycle,
                 WornBody<dim>& body);

/// Remarks where nothing slides although it would wear, and where the counter-body turns about a
/// point of the surface, in space: there the worn volume is of first order in the size of facets.
template <int dim>
void remark_on_speeds(const Scene& scene, const std::optional<PartCycle<dim>>& cycle,
                      WornBody<dim>& body);

}  // namespace gnomon::part
