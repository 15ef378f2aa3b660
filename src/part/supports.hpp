// What holds a part: supports of the displacement by name.
#pragma once

#include <algorithm>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

#include "model/foundation.hpp"

namespace gnomon::part {

/// Keys of `[[support]]`.
std::vector<Key> support_keys();

/// Positions of the directions that a support, "support.1", names, or of all. Throws InputError.
template <int dim>
std::vector<int> directions_of(const Scene& scene, const std::string& support);

/// What is wrong in [[support]] whatever the mesh is.
void find_mistakes_of_supports(const Scene& scene, Mistakes& mistakes);

/// Also what the axis of a body of revolution holds. Throws InputError.
template <int dim>
Supports<dim> read_supports(const Scene& scene, const ImportedBody<dim>& part);

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

}  // namespace gnomon::part
