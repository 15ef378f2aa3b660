// What steady rolling shows: creepages, stick, and the power that friction dissipates.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/model/observation.hpp>
#include <vector>

namespace gnomon {

/// Of the whole body.
struct PowerOfRolling {
  double dissipated = 0;  ///< by friction [force length / time]
  /// The power that differences upwind add: an error of the mesh, the largest of most scenes.
  double upwind = 0;
  double stick_area = 0;  ///< [length^(dim-1)]
  /// Of the contact force, the part on nodes without friction: no material comes to them.
  double without_friction = 0;
};

/// `moved`: WornBodyEquations::moved_on_partner(); `nodes`: the contact nodes of the state.
template <int dim>
PowerOfRolling power_of_rolling(const Assembly<dim>& assembly, const NodalField<dim>& moved,
                                const std::vector<ContactNode<dim>>& nodes);

/// Of the forces along the contact on a body whose material slides on its partner as `rolling`
/// says, as rigid bodies do. That of friction differs from it by what pressures take along as they
/// move the surfaces, which between similar half-spaces is nothing [force length / time].
template <int dim>
double driving_power(const Assembly<dim>& assembly, const std::vector<ContactNode<dim>>& nodes,
                     const Rolling<dim>& rolling);

/// Appends creepage_x, ..., creepage_spin where a moment determines it, friction_power and
/// stick_area. `rolling`: as found; `units`: as for common().
template <int dim>
void observe_rolling(const Assembly<dim>& assembly, const NodalField<dim>& moved,
                     const std::vector<ContactNode<dim>>& nodes, const Rolling<dim>& rolling,
                     int units, Observation& observed);

}  // namespace gnomon
