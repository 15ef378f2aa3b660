// Why a pair has no facets that face each other.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>

#include "part/facing_facets.hpp"

namespace gnomon::part {

/// Throws InputError. `pair`: a side of it is empty, what was looked at is in its `boundary`; `x`:
/// of the nodes at each place of the bodies.
template <int dim>
[[noreturn]] void refuse_facing(const Scene& scene, const std::string& table,
                                const ImportedBody<dim>& part, const BodyOfFacets<dim>& body_of,
                                const MortarPair<dim>& pair,
                                const std::vector<std::vector<Vector<dim>>>& x);

}  // namespace gnomon::part
