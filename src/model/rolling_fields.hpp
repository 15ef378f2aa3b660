// The fields that steady rolling adds to those of a wearing assembly.
#pragma once

#include <gnomon/fields/field.hpp>
#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// Of pairs: the components of the creepage that forces determine.
template <int dim>
FieldId add_creepage(const Assembly<dim>& body, const Scales& scales, FieldSet& set);

}  // namespace gnomon
