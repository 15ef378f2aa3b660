// Quadrilaterals from triangles, hexahedra from tetrahedra and wedges.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>

namespace gnomon {

/// Whether the mesh has other cells than quadrilaterals (hexahedra in space).
bool needs_subdivision(const ImportedMesh& mesh);

/// One quadrilateral (hexahedron) for each corner of every cell, between the corner, the midpoints
/// of its edges, the centroids of its faces and that of the cell: 3 from a triangle, 4 from a
/// quadrilateral or a tetrahedron, 6 from a wedge, 8 from a hexahedron. Neighbours share the new
/// nodes, whose tag is 0; new cells and facets have the tag of that which they are a part of.
/// Edges stay straight. Facets and groups follow; a facet that is no side of a cell stays as it is.
/// Throws InputError at a pyramid, whose tip has four edges.
ImportedMesh subdivide(const ImportedMesh& mesh);

}  // namespace gnomon
