#include "model/upstream.hpp"

#include <algorithm>

namespace gnomon {

namespace {

/// h, H: the distances of the next two nodes; 0 < h < H.
Upstream second_order(int node, int next, int second, double h, double H) {
  const double distance = h * H / (h + H);
  return {node,
          {{next, H * H / ((H - h) * (H + h))}, {second, -h * h / ((H - h) * (H + h))}},
          distance};
}

/// h, H: the distances of the nodes on both sides, `next` downstream.
void compare_with_central(int next, double h, double H, Upstream& at) {
  at.upwind = {{at.node, 1 / at.distance - (H - h) / (h * H)}, {next, -h / (H * (h + H))}};
  for (const auto& [node, factor] : at.from) at.upwind.emplace_back(node, -factor / at.distance);
  at.upwind[2].second += H / (h * (h + H));
}

}  // namespace

template <int dim>
Vector<dim> streamed(const Mesh<dim>& mesh, const Upstream& at) {
  Vector<dim> result = mesh.nodes[static_cast<std::size_t>(at.node)];
  for (const auto& [node, factor] : at.from)
    result -= factor * mesh.nodes[static_cast<std::size_t>(node)];
  return result;
}

template <int dim>
std::vector<Upstream> upstream_of(const Assembly<dim>& assembly) {
  std::vector<Upstream> result;
  for (const Surface<dim>& surface : assembly.interface.surfaces) {
    if (!surface.track) continue;
    SurfaceLines lines = lines_of_surface(assembly.mesh, surface.facets, surface.track->along);
    for (std::vector<int>& line : lines.nodes) {
      const auto distance = [&](std::size_t a, std::size_t b) {
        return (assembly.mesh.nodes[static_cast<std::size_t>(line[b])] -
                assembly.mesh.nodes[static_cast<std::size_t>(line[a])])
            .norm();
      };
      for (std::size_t k = 1; k < line.size(); ++k) {
        if (k == 1) {
          result.push_back({line[1], {{line[0], 1}}, distance(0, 1)});
          continue;
        }
        result.push_back(second_order(line[k], line[k - 1], line[k - 2], distance(k - 1, k),
                                      distance(k - 2, k)));
        if (k + 1 < line.size())
          compare_with_central(line[k + 1], distance(k - 1, k), distance(k, k + 1), result.back());
      }
    }
  }
  std::erase_if(result, [&](const Upstream& at) {
    return !assembly.carries[static_cast<std::size_t>(assembly.contact_node(at.node))];
  });
  return result;
}

template Vector<2> streamed(const Mesh<2>&, const Upstream&);
template Vector<3> streamed(const Mesh<3>&, const Upstream&);
template std::vector<Upstream> upstream_of(const Assembly<2>&);
template std::vector<Upstream> upstream_of(const Assembly<3>&);

}  // namespace gnomon
