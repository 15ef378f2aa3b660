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

/// That forces along the surface at the start are more than friction holds at these contact nodes;
/// empty: they are less.
template <int dim>
std::string excess_at_start(const Assembly<dim>& assembly,
                            const std::vector<ContactNode<dim>>& nodes);

}  // namespace gnomon
