// Which nodes of a mesh are connected by cells.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon {

/// By node: the number of the connected part that it belongs to, from 0 in the order of their first
/// nodes. `cells`: nodes of all cells, `corners` of each, one after the other.
std::vector<int> connected_nodes(std::size_t nodes, std::span<const int> cells,
                                 std::size_t corners);

}  // namespace gnomon
