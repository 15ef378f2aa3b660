#include <fmt/format.h>

#include <gnomon/results/results.hpp>
#include <iterator>

#include "results/xdmf_sidecar.hpp"

namespace gnomon {

namespace {

constexpr const char* view_begin =
    "    <Grid Name=\"mesh\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";

/// Numbers in rows, as an item of XDMF.
template <class Number>
std::string item(const std::vector<Number>& numbers, std::size_t columns, const char* type) {
  std::string text = fmt::format("<DataItem Format=\"XML\" {} Dimensions=\"{} {}\">", type,
                                 numbers.size() / columns, columns);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    fmt::format_to(std::back_inserter(text), "{}{}", k % columns == 0 ? '\n' : ' ', numbers[k]);
  return text + "</DataItem>";
}

/// A grid of elements of `corners` nodes each, with the nodes that they use, in ascending order.
void add_grid(std::string& text, const Grid& grid, const std::string& name,
              const std::vector<int>& elements, std::size_t corners, const char* topology) {
  constexpr int unused = -1, used = 0;
  std::vector<int> number(grid.points.size(), unused);
  for (const int node : elements) number[node] = used;
  std::vector<double> points;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] == unused) continue;
    number[node] = static_cast<int>(points.size() / 3);
    points.insert(points.end(), grid.points[node].begin(), grid.points[node].end());
  }
  std::vector<int> renumbered;
  for (const int node : elements) renumbered.push_back(number[node]);
  text +=
      fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n{}      </Grid>\n", escaped(name),
                  mesh_text(topology, elements.size() / corners,
                            item(renumbered, corners, "NumberType=\"Int\" Precision=\"4\""),
                            item(points, 3, "NumberType=\"Float\" Precision=\"8\"")));
}

}  // namespace

std::string mesh_view(const Grid& grid, const std::string& axes) {
  const bool flat = grid.cell == Grid::Cell::quadrilateral;
  std::string text = std::string(xdmf_head) + view_begin;
  text += fmt::format("      <Information Name=\"axes\" Value=\"{}\"/>\n", axes);
  add_grid(text, grid, "body", grid.cells, flat ? 4 : 8, flat ? "Quadrilateral" : "Hexahedron");
  for (const MeshPart& part : grid.parts) {
    if (part.kind == MeshPart::Kind::exterior || part.kind == MeshPart::Kind::cells ||
        part.nodes.empty())
      continue;
    if (part.kind == MeshPart::Kind::points)
      add_grid(text, grid, part.name, part.nodes, 1, "Polyvertex\" NodesPerElement=\"1");
    else
      add_grid(text, grid, part.name, part.nodes, flat ? 2 : 4,
               flat ? "Polyline\" NodesPerElement=\"2" : "Quadrilateral");
  }
  return text + "    </Grid>\n" + xdmf_end;
}

bool is_mesh_view(const std::filesystem::path& file) {
  return begins_with(file, std::string(xdmf_head) + view_begin);
}

}  // namespace gnomon
