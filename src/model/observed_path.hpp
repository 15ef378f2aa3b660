// What a path shows beside other cycles: friction, slip and the fretting loop.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <optional>
#include <vector>

#include "model/slip_zone.hpp"

namespace gnomon {

/// What the slip of a path makes in a cycle, of the whole body.
struct CycleOfSlip {
  double work = 0;  ///< of friction, at the mean pressure of neighbouring phases [force length]
  double path = 0;  ///< the longest of a node [length]
  double stick_area = 0;  ///< of nodes that touch and slip by less than 1e-3 of it [length^(dim-1)]
  double slip_area = 0;   ///< of the others that touch, in some phase
  std::vector<Hold> holds{};  ///< by contact node
};
template <int dim>
CycleOfSlip cycle_of_slip(const Assembly<dim>& assembly,
                          const std::vector<PhaseContact<dim>>& phases);

/// The axis about which the partner turns over a path: the counter-body, or in space one body of
/// the first pair alone, about the approach.
template <int dim>
struct AxisOfPath {
  Tensor<dim> spin;    ///< of the rate one
  Vector<dim> centre;  ///< in the coordinates of the shape, or of the body that turns [length]
  int side = -1;       ///< of a pair: which of its bodies turns, slave or master
};
template <int dim>
std::optional<AxisOfPath<dim>> axis_of_path(const Assembly<dim>& assembly);

/// Whether friction changes over the loop, beyond rounding.
template <int dim>
bool is_rubbed(const Assembly<dim>& assembly, const std::vector<PlaceAndForce<dim>>& loop);

/// Appends friction_work, slip_path, stick_area, stroke and friction_force, and where the partner
/// turns twist and friction_moment. `units`: the dimension that they have.
template <int dim>
void observe_path(const Assembly<dim>& assembly, const std::vector<PhaseContact<dim>>& phases,
                  const std::vector<PlaceAndForce<dim>>& loop, int units, Observation& observed);

/// Appends traction and slip of the contact nodes in a phase, or in rolling.
template <int dim>
void add_friction(const std::vector<ContactNode<dim>>& nodes, ContactSurface& surface);

}  // namespace gnomon
