// The boundary beside the wearing surfaces that the counter-body can touch.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>

namespace gnomon::part {

/// A surface that touches but does not wear: the facets of the boundary, outside of the surfaces
/// that `parts` have, that face the counter-body in some instant and that it reaches when it moves
/// by `depth` beyond its first touch. Without facets where there are none. What supports hold
/// across itself is left out.
template <int dim>
Surface<dim> reachable_boundary(const AssemblyParts<dim>& parts, double depth);

}  // namespace gnomon::part
