#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/extrusion.hpp>

namespace gnomon {

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
