// To which connected part of the mesh, and to which body, nodes belong.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon {

/// By node: the number of the connected part of the mesh to which it belongs.
template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh);

/// By body: that of its cells.
template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh, const std::vector<Body>& bodies);

/// By node: the last of the bodies that have it, by those of the cells.
template <int dim>
std::vector<int> body_of_nodes(const Mesh<dim>& mesh, const std::vector<int>& body_of_cells);

/// By node: all of them; several where bodies are bonded.
template <int dim>
std::vector<std::vector<int>> bodies_at_nodes(const Mesh<dim>& mesh,
                                              const std::vector<int>& body_of_cells);

}  // namespace gnomon
