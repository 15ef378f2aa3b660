#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/extrusion.hpp>

namespace gnomon {

Mesh<2> structured_quadrilaterals(int nx, int ny,
                                  const std::function<Vector<2>(double s, double t)>& place) {
  Mesh<2> mesh;
  const auto node = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(place(double(i) / nx, double(j) / ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      mesh.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  for (int i = 0; i < nx; ++i) {
    mesh.boundary["bottom"].push_back({node(i, 0), node(i + 1, 0)});
    mesh.boundary["top"].push_back({node(i + 1, ny), node(i, ny)});
  }
  for (int j = 0; j < ny; ++j) {
    mesh.boundary["left"].push_back({node(0, j + 1), node(0, j)});
    mesh.boundary["right"].push_back({node(nx, j), node(nx, j + 1)});
  }
  return mesh;
}

Extrusion extrude(const Mesh<2>& section, const std::vector<double>& lines) {
  if (lines.size() < 2 ||
      std::adjacent_find(lines.begin(), lines.end(), std::greater_equal<>()) != lines.end())
    throw Error("extrusion: at least two ascending grid lines are needed");
  const int count = static_cast<int>(lines.size()), last = count - 1;
  const auto node = [count](int p, int i) { return p * count + i; };
  Extrusion result;
  result.section = section;
  Mesh<3>& mesh = result.mesh;
  for (int p = 0; p < static_cast<int>(section.nodes.size()); ++p)
    for (double x : lines) {
      mesh.nodes.emplace_back(x, section.nodes[p][0], section.nodes[p][1]);
      result.section_node.push_back(p);
    }
  for (const auto& [p, q, r, s] : section.cells) {
    for (int i = 0; i < last; ++i)
      mesh.cells.push_back({node(p, i), node(q, i), node(r, i), node(s, i),  //
                            node(p, i + 1), node(q, i + 1), node(r, i + 1), node(s, i + 1)});
    mesh.boundary["begin"].push_back({node(s, 0), node(r, 0), node(q, 0), node(p, 0)});
    mesh.boundary["end"].push_back({node(p, last), node(q, last), node(r, last), node(s, last)});
  }
  for (const auto& [name, facets] : section.boundary)
    for (const auto& [p, q] : facets)
      for (int i = 0; i < last; ++i)
        mesh.boundary[name].push_back({node(p, i), node(q, i), node(q, i + 1), node(p, i + 1)});
  return result;
}

}  // namespace gnomon
