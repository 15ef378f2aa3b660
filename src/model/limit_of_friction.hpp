// In steady rolling: where friction holds no more than the forces along the surface.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// At a state whose creepage forces alone determine, when friction is as good as exhausted: where
/// all slips, creepage is without a bound. `nodes`: the contact nodes of the state.
template <int dim>
std::optional<Limit> limit_of_friction(const Assembly<dim>& assembly,
                                       const std::vector<ContactNode<dim>>& nodes);

}  // namespace gnomon
