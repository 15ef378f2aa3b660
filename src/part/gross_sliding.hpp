// Whether the bodies slide wherever they touch, over a whole cycle.
#pragma once

#include "part/phases.hpp"

namespace gnomon::part {

/// Refuses a motion whose strokes are shorter than the elastic shear of the contact: part of the
/// contact would stick, which depends on the path within the cycle. By Mindlin's formula for round
/// bodies (K. L. Johnson, Contact Mechanics, eq. 7.43); `parts` have their scales. Short strokes
/// that are less than a twentieth of the path are let pass. Throws InputError.
template <int dim>
void require_gross_sliding(const Scene& scene, const CyclicMotion<dim>& cycle,
                           const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
