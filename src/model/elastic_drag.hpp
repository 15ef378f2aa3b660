// How far friction drags the contact with a motion that reverses.
#pragma once

#include <gnomon/model/examination.hpp>
#include <gnomon/model/wear_model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Absent without friction, where it may stick, and of motions that do not come back.
template <int dim>
std::optional<ElasticDrag> find_drag(const WornBodyEquations<dim>& equations,
                                     const FieldValues<dim>& values,
                                     const std::vector<PhaseContact<dim>>& contacts);

}  // namespace gnomon
