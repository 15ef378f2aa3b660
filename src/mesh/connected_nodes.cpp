#include "mesh/connected_nodes.hpp"

#include <algorithm>
#include <numeric>

namespace gnomon {

std::vector<int> connected_nodes(std::size_t nodes, std::span<const int> cells,
                                 std::size_t corners) {
  std::vector<int> root(nodes);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const int one = find(cells[k]), other = find(cells[k - k % corners]);
    root[std::max(one, other)] = std::min(one, other);
  }
  std::vector<int> number(root.size(), -1), part;
  int parts = 0;
  for (std::size_t node = 0; node < root.size(); ++node) {
    int& own = number[find(static_cast<int>(node))];
    if (own < 0) own = parts++;
    part.push_back(own);
  }
  return part;
}

}  // namespace gnomon
