// Rotations of bodies that have small strains.
#pragma once

#include <gnomon/model/examination.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <optional>

namespace gnomon {

/// The largest one, in any phase: that of the rigid motion which the displacements of the nodes of
/// a body differ from least. Absent where no body has small strains.
template <int dim>
std::optional<BodyTurn> find_body_turn(const WornBodyEquations<dim>& equations,
                                       const FieldValues<dim>& values);

}  // namespace gnomon
