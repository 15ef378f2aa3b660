// Watches the worn mesh: elements that wear has nearly used up, or folded, end a run.
#pragma once

#include <gnomon/model.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Throws SolutionError when the scalars of a state tell of an element that is folded
/// ("element_quality" not positive) or has less than a hundredth of its volume ("element_volume").
void require_sound_mesh(const std::vector<Scalar>& scalars);

/// What is said when that is near (a tenth of the volume, a scaled Jacobian of 0.1); empty when it
/// is not.
std::string mesh_warning(const std::vector<Scalar>& scalars);

}  // namespace gnomon
