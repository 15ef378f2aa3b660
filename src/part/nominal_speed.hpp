// The speed at which a counter-body slides, for the sliding distance s and typical magnitudes.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>

#include "part/part_cycle.hpp"

namespace gnomon::part {

/// A counter-body that knows where it meets the contact surface first (RigidMotion::reference and
/// normal), and the speed at which it slides there: wear.velocity, or that of its motion, the mean
/// over the cycle.
template <int dim>
struct Meeting {
  CounterBody<dim> partner;
  double speed;
};

/// Throws InputError where the bodies do not meet.
template <int dim>
Meeting<dim> find_meeting(const Scene& scene, const std::vector<ContactPatch<dim>>& patches,
                          const CounterBody<dim>& rest,
                          const std::optional<CyclicMotion<dim>>& cycle);

/// Remarks where nothing slides although it would wear, and where the counter-body turns about a
/// point of the surface, in space: there the worn volume is of first order in the size of facets.
template <int dim>
std::vector<std::string> remarks_on_speeds(const Scene& scene,
                                           const std::vector<ContactPatch<dim>>& patches,
                                           const CounterBody<dim>& rest,
                                           const std::optional<CyclicMotion<dim>>& cycle);

}  // namespace gnomon::part
