// What friction of a contact is along, and what presses it is across.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <vector>

namespace gnomon {

/// The normal of the plane, where one of the bodies is one in contact. Of round bodies the approach
/// of the first pair or of the counter-body, or what is across a contact that is clearly inclined
/// to it: their mean normal, by the forces over the phases, is off it by as much as contact is not
/// symmetric. Unit.
template <int dim>
Vector<dim> across_contact(const Assembly<dim>& assembly,
                           const std::vector<PhaseContact<dim>>& phases);

}  // namespace gnomon
