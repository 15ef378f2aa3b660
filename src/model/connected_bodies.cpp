#include <algorithm>
#include <gnomon/model/model.hpp>

#include "mesh/connected_nodes.hpp"

namespace gnomon {

std::vector<int> connected_bodies(const Grid& grid) {
  return connected_nodes(grid.points.size(), grid.cells, grid.corners());
}

void find_bodies(const Grid& grid, ContactSurface& surface) {
  const std::vector<int> body = connected_bodies(grid);
  if (body.empty() || *std::ranges::max_element(body) == 0) return;
  surface.body.clear();
  for (const int node : surface.node)
    surface.body.push_back(body.at(static_cast<std::size_t>(node)));
}

}  // namespace gnomon
