// Where forces on bodies act: those with small strains are undeformed there.
#pragma once

#include <gnomon/model/worn_body_equations.hpp>
#include <vector>

namespace gnomon {

/// By node: the connected part of the mesh whose travel stands for its displacement, or -1. Forces
/// on bodies with small strains balance where these are undeformed, wherever they have travelled.
template <int dim>
std::vector<int> undeformed_parts(const Assembly<dim>& assembly);

/// Places of all nodes in the frames of their bodies, nodes x dim [length]; `undeformed`: by node,
/// undeformed_parts().
template <int dim>
NodalField<dim> places_of(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                          const WornBodyFields& fields, const std::vector<int>& undeformed);

}  // namespace gnomon
