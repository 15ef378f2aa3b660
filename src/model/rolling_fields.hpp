// The fields that steady rolling adds to those of a wearing assembly.
#pragma once

#include <gnomon/fields/field.hpp>
#include <gnomon/model/assembly.hpp>
#include <utility>

namespace gnomon {

/// Of pairs: the components of the creepage that forces determine, and the spin of a moment, else
/// none.
template <int dim>
std::pair<FieldId, FieldId> add_creepage(const Assembly<dim>& body, const Scales& scales,
                                         FieldSet& set);

/// The mean of the power of friction over each contact, of the rigid partner or of each pair; none
/// where no wear law reads it.
template <int dim>
FieldId add_mean_power(const Assembly<dim>& body, const Scales& scales, FieldSet& set);

}  // namespace gnomon
