#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/section.hpp>

namespace gnomon {

std::vector<int> axis_nodes(const Mesh<2>& mesh) {
  double largest = 0;
  for (const Vector<2>& X : mesh.nodes) largest = std::max(largest, X[0]);
  const double near = 1e-9 * largest;
  std::vector<int> nodes;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const Vector<2>& X = mesh.nodes[node];
    if (X[0] < -near)
      throw InputError(fmt::format(
          "the mesh: expected r >= 0 in a body of revolution about r = 0, got a node at ({:g}, "
          "{:g})",
          X[0], X[1]));
    if (X[0] <= near) nodes.push_back(static_cast<int>(node));
  }
  return nodes;
}

}  // namespace gnomon
