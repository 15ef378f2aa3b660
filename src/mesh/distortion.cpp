#include <algorithm>
#include <gnomon/mesh/distortion.hpp>
#include <limits>
#include <random>

namespace gnomon {

namespace {

/// Whether two corners of a cell, in VTK order, are joined by an edge.
bool joined(int a, int b) {
  if (a / 4 != b / 4) return a % 4 == b % 4;
  return (a + b) % 2 == 1;
}

template <int dim>
std::vector<double> shortest_edges(const Mesh<dim>& mesh) {
  std::vector<double> shortest(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (const auto& cell : mesh.cells)
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      for (int b = 0; b < Mesh<dim>::cell_nodes; ++b)
        if (joined(a, b))
          shortest[cell[a]] =
              std::min(shortest[cell[a]], (mesh.nodes[cell[a]] - mesh.nodes[cell[b]]).norm());
  return shortest;
}

}  // namespace

template <int dim>
void distort(Mesh<dim>& mesh, double amount) {
  std::vector<double> reach = shortest_edges(mesh);
  for (const auto& [name, part] : mesh.boundary)
    for (const auto& facet : part)
      for (int node : facet) reach[node] = 0;
  // The standard fixes the numbers of this generator, unlike those of its distributions.
  std::mt19937 generator;
  const auto uniform = [&generator] {
    return 2.0 * static_cast<double>(generator()) / std::mt19937::max() - 1;
  };
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (int i = 0; i < dim; ++i) mesh.nodes[node][i] += amount * reach[node] * uniform();
}

template void distort(Mesh<2>&, double);
template void distort(Mesh<3>&, double);

}  // namespace gnomon
