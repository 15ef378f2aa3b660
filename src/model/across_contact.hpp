// What friction of a contact is along, and what presses it is across.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <vector>

namespace gnomon {

/// The approach of the first pair or of the counter-body, or where contact is inclined to it the
/// mean normal of what is pressed over the phases: unit. Round bodies tell it only as well as
/// pressures are symmetric, flat ones exactly, and the flatter of two bodies counts.
template <int dim>
Vector<dim> across_contact(const Assembly<dim>& assembly,
                           const std::vector<PhaseContact<dim>>& phases);

}  // namespace gnomon
