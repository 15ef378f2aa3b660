// Checks of a body's cells and of what they make up.
#pragma once

#include <gnomon/mesh/imported_body.hpp>

#include "mesh/facet_table.hpp"

namespace gnomon {

/// "element 12 at (1, 2)".
template <int dim>
std::string cell_text(const ImportedBody<dim>& body, int cell);

/// Turns cells that are inside out by their order. Refuses those that are folded or have no volume.
/// Remarks badly shaped ones.
template <int dim>
void orient_cells(ImportedBody<dim>& body);

/// (connection.cpp) Refuses cells that overlap at a facet, nodes of the boundary within a facet of
/// it, a body in several parts, and one that touches itself in a node (2D) or an edge (3D) only.
/// `exterior` has to be filled.
template <int dim>
void check_connection(const ImportedBody<dim>& body, const FacetTable<dim>& facets,
                      std::size_t most_parts);

/// (import_groups.cpp) Fills the groups of the body from those of the mesh it was made of.
template <int dim>
void take_groups(ImportedBody<dim>& body, const FacetTable<dim>& facets, const ImportedMesh& mesh);

/// (boundary_order.cpp) Numbers the nodes of the boundary along it and sorts all facets so;
/// numbers ascend in the parts named `first`, if in any.
void order_along_boundary(ImportedBody<2>& body, const std::vector<std::string>& first);

}  // namespace gnomon
