// Checks and repairs of an imported mesh before it is one of gnomon's.
#pragma once

#include <gnomon/mesh/imported_mesh.hpp>

namespace gnomon {

/// Throws InputError in the form "FILE: why".
[[noreturn]] void refuse_mesh(const ImportedMesh& mesh, const std::string& why);

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
void merge_equal_nodes(ImportedMesh& mesh);

/// Nodes of no cell go, also from groups of points; in facets they become -1.
void drop_unused_nodes(ImportedMesh& mesh);

/// Of cells with the same nodes the first stays. Refuses cells that have a node twice.
void drop_equal_cells(ImportedMesh& mesh);

}  // namespace gnomon
