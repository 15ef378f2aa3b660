#include "gmsh/folded_cells.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::gmsh_reader {

namespace {

using Tags = std::vector<std::size_t>;
using Point = std::array<double, 3>;

/// Places of nodes by their tags.
std::vector<Point> places() {
  Tags tags;
  std::vector<double> at, ignored;
  gmsh::model::mesh::getNodes(tags, at, ignored, -1, -1, false, false);
  std::vector<Point> result(tags.empty() ? 0 : *std::ranges::max_element(tags) + 1);
  for (std::size_t i = 0; i < tags.size(); ++i)
    result[tags[i]] = {at[3 * i], at[3 * i + 1], at[3 * i + 2]};
  return result;
}

double jacobian(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

bool is_folded(std::span<const std::size_t> nodes, const std::vector<Point>& at) {
  constexpr int corner[2][2][2] = {{{0, 1}, {3, 2}}, {{4, 5}, {7, 6}}};  // by z, y, x
  const auto edge = [&](int from, int to) {
    const Point &a = at[nodes[from]], &b = at[nodes[to]];
    return Point{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  };
  const bool is_flat = nodes.size() == 4;
  bool has_positive = false, has_negative = false;
  for (int k = 0; k < (is_flat ? 1 : 2); ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double J =
            jacobian(edge(corner[k][j][0], corner[k][j][1]), edge(corner[k][0][i], corner[k][1][i]),
                     is_flat ? Point{0, 0, 1} : edge(corner[0][j][i], corner[1][j][i]));
        has_positive |= J >= 0;
        has_negative |= J <= 0;
      }
  return has_positive && has_negative;
}

}  // namespace

bool has_folded_cells(int dimension) {
  constexpr int quadrilateral = 3, hexahedron = 5;
  const std::size_t corners = dimension == 2 ? 4 : 8;
  Tags cells, nodes;
  gmsh::model::mesh::getElementsByType(dimension == 2 ? quadrilateral : hexahedron, cells, nodes);
  const std::vector<Point> at = places();
  for (std::size_t first = 0; first < nodes.size(); first += corners)
    if (is_folded(std::span(nodes).subspan(first, corners), at)) return true;
  return false;
}

}  // namespace gnomon::gmsh_reader
