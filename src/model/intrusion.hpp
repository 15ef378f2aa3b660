// Where a counter-body is inside a body without contact.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// The deepest of the boundary without contact inside the counter-body, in any phase: nodes that
/// cannot touch, and where no node does, points between them.
template <int dim>
std::optional<BoundaryPoint> find_intrusion(const WornBodyEquations<dim>& equations,
                                            const FieldValues<dim>& values, double t,
                                            const std::vector<PhaseContact<dim>>& contacts);

/// Of pairs: the deepest of the boundary that does not take part in contact inside the other body,
/// in any phase.
template <int dim>
std::optional<BoundaryPoint> find_intrusion_of_pairs(const WornBodyEquations<dim>& equations,
                                                     const FieldValues<dim>& values);

}  // namespace gnomon
