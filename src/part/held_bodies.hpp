// Whether supports, springs, contact and loads keep every body where it is.
#pragma once

#include <algorithm>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

#include "model/foundation.hpp"

namespace gnomon::part {

/// Throws InputError where bodies of pairs that contact alone holds in some way have no load along
/// it, or loads that pull them off what they touch, at any time and in any phase.
template <int dim>
void require_pressed_pairs(const Scene& scene, const AssemblyParts<dim>& parts);

/// Whether a load has a history.
template <int dim>
bool loads_change(const std::vector<Load<dim>>& loads) {
  return std::ranges::any_of(loads,
                             [](const Load<dim>& load) { return load.history.times().size() > 1; });
}
/// The ends of the straight lines of all load histories.
template <int dim>
std::vector<LoadTime> load_times(const Scene& scene, const std::vector<Load<dim>>& loads);

/// Throws InputError where supports, springs and the contact leave the bodies free to move as a
/// whole, and says how. `hint`: what else may be wrong then, or nothing.
template <int dim>
void require_held(const Scene& scene, const AssemblyParts<dim>& parts, const std::string& hint);

/// How far a motion of a part brings its surface nearer to what it touches, and away from it: areas
/// times velocities.
struct Closing {
  double closes = 0, opens = 0;

  bool is_one_sided() const {
    constexpr double oblique = 1e-3;
    return std::min(closes, opens) <= oblique * std::max(closes, opens);
  }
};
template <int dim>
Closing closing_of(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                   const Twist<dim>& motion) {
  Closing sum;
  for (const ContactPatch<dim>& patch : contact_nodes_of(parts)) {
    if (!part.has(patch.node)) continue;
    const Vector<dim> velocity =
        rigid_velocities<dim>(patch.initial_position, part.centre, part.size) * motion;
    const double closes = patch.initial_area * patch.initial_normal.dot(velocity);
    (closes > 0 ? sum.closes : sum.opens) += std::abs(closes);
  }
  return sum;
}

}  // namespace gnomon::part
