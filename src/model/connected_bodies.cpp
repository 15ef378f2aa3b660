#include <algorithm>
#include <gnomon/model/model.hpp>
#include <numeric>

namespace gnomon {

std::vector<int> connected_bodies(const Grid& grid) {
  std::vector<int> root(grid.points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  const std::size_t corners = grid.corners();
  for (std::size_t k = 0; k < grid.cells.size(); ++k) {
    const int one = find(grid.cells[k]), other = find(grid.cells[k - k % corners]);
    root[std::max(one, other)] = std::min(one, other);
  }
  std::vector<int> number(root.size(), -1), body;
  int bodies = 0;
  for (std::size_t node = 0; node < root.size(); ++node) {
    int& own = number[find(static_cast<int>(node))];
    if (own < 0) own = bodies++;
    body.push_back(own);
  }
  return body;
}

void find_bodies(const Grid& grid, ContactSurface& surface) {
  const std::vector<int> body = connected_bodies(grid);
  if (body.empty() || *std::ranges::max_element(body) == 0) return;
  surface.body.clear();
  for (const int node : surface.node)
    surface.body.push_back(body.at(static_cast<std::size_t>(node)));
}

}  // namespace gnomon
