#include "model/connected_parts.hpp"

#include <algorithm>

#include "mesh/connected_nodes.hpp"

namespace gnomon {

template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh) {
  const std::size_t corners = Mesh<dim>::cell_nodes;
  return connected_nodes(
      mesh.nodes.size(),
      {mesh.cells.empty() ? nullptr : mesh.cells.front().data(), corners * mesh.cells.size()},
      corners);
}

template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh, const std::vector<Body>& bodies) {
  const std::vector<int> part = connected_parts(mesh);
  std::vector<int> result;
  for (const Body& body : bodies)
    result.push_back(part[static_cast<std::size_t>(
        mesh.cells[static_cast<std::size_t>(body.cells.front())][0])]);
  return result;
}

template <int dim>
std::vector<int> body_of_nodes(const Mesh<dim>& mesh, const std::vector<int>& body_of_cells) {
  std::vector<int> body(mesh.nodes.size(), -1);
  for (std::size_t cell = 0; cell < body_of_cells.size(); ++cell)
    for (const int node : mesh.cells[cell]) body[node] = body_of_cells[cell];
  return body;
}

template <int dim>
std::vector<std::vector<int>> bodies_at_nodes(const Mesh<dim>& mesh,
                                              const std::vector<int>& body_of_cells) {
  std::vector<std::vector<int>> bodies(mesh.nodes.size());
  for (std::size_t cell = 0; cell < body_of_cells.size(); ++cell)
    for (const int node : mesh.cells[cell])
      if (std::ranges::count(bodies[node], body_of_cells[cell]) == 0)
        bodies[node].push_back(body_of_cells[cell]);
  return bodies;
}

template std::vector<int> connected_parts(const Mesh<2>&);
template std::vector<int> connected_parts(const Mesh<3>&);
template std::vector<int> connected_parts(const Mesh<2>&, const std::vector<Body>&);
template std::vector<int> connected_parts(const Mesh<3>&, const std::vector<Body>&);
template std::vector<int> body_of_nodes(const Mesh<2>&, const std::vector<int>&);
template std::vector<int> body_of_nodes(const Mesh<3>&, const std::vector<int>&);
template std::vector<std::vector<int>> bodies_at_nodes(const Mesh<2>&, const std::vector<int>&);
template std::vector<std::vector<int>> bodies_at_nodes(const Mesh<3>&, const std::vector<int>&);

}  // namespace gnomon
