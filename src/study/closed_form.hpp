// The closed form of a problem, where it has one, as the reference of a study.
#pragma once

#include <gnomon/model/model.hpp>
#include <vector>

namespace gnomon::study {

/// The contact surface at these times; empty without a closed form. Throws InputError for a problem
/// that has one, but no contact surface to compare.
std::vector<ContactSurface> closed_form(const Model& model, const std::vector<double>& times);

}  // namespace gnomon::study
