// Checks and repairs of an imported mesh before it is one of gnomon's.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_mesh.hpp>

#include "mesh/edge_bulges.hpp"

namespace gnomon {

/// Throws InputError in the form "FILE: why".
[[noreturn]] void refuse_mesh(const std::string& file, const std::string& why);

/// Cells of a mesh do not meet side to side, of one body or of several.
class UnconnectedCells : public InputError {
public:
  using InputError::InputError;
};

/// "1 node", "3 nodes".
std::string counted(long count, const char* what);

/// "(1, 2, 3)", for messages.
std::string place_text(std::span<const double> place);

/// Diagonal of the box around all nodes [length].
double diagonal(const ImportedMesh& mesh);

/// Refuses another dimension than `dim`, cells of unknown nodes, coordinates that are no numbers.
void check_content(const ImportedMesh& mesh, int dim);

/// Gives nodes new numbers, `now[node]`, in elements and groups of points.
void renumber_nodes(ImportedMesh& mesh, const std::vector<int>& now);

/// Refuses surfaces in space as bodies in the plane; a constant z becomes zero.
void lay_in_plane(ImportedMesh& mesh);

/// (merge_nodes.cpp) Nodes nearer to each other than 1e-8 of the diagonal become one, that of the
/// least index.
void merge_equal_nodes(ImportedMesh& mesh, const std::vector<std::string>& separate = {});

/// Nodes of no cell go, also from groups of points; in facets they become -1.
void drop_unused_nodes(ImportedMesh& mesh);

/// Of cells with the same nodes the first stays. Refuses cells that have a node twice.
void drop_equal_cells(ImportedMesh& mesh);

/// Whether the mesh has other cells than quadrilaterals (hexahedra in space).
bool needs_subdivision(const ImportedMesh& mesh);

/// (subdivision.cpp) One quadrilateral (hexahedron) for each corner of every cell, between the
/// corner, the midpoints of its edges, the centroids of its faces and that of the cell: 3 from a
/// triangle, 4 from a quadrilateral or a tetrahedron, 6 from a wedge, 8 from a hexahedron.
/// Neighbours share the new nodes, whose tag is 0; new cells and facets have the tag of that which
/// they are a part of. Facets and groups follow; a facet that is no side of a cell stays as it is.
/// Edges stay straight but for those that have bulges, which middles of faces and cells follow.
/// Throws InputError at a pyramid, whose tip has four edges.
ImportedMesh subdivide(const ImportedMesh& mesh, const EdgeBulges& bulges = {});

}  // namespace gnomon
