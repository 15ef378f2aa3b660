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

/// Those of a line, in the order in which material passes its nodes. The first node of a line with
/// ends has none upstream.
template <int dim>
void add_line(const Mesh<dim>& mesh, const std::vector<int>& line, bool closed,
              std::vector<Upstream>& result) {
  const std::size_t count = line.size();
  const auto node = [&](std::size_t k) { return line[k % count]; };
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (mesh.nodes[static_cast<std::size_t>(node(b))] -
            mesh.nodes[static_cast<std::size_t>(node(a))])
        .norm();
  };
  if (!closed && count > 1) result.push_back({line[1], {{line[0], 1}}, distance(0, 1)});
  for (std::size_t k = 2; k < (closed ? count + 2 : count); ++k) {
    result.push_back(
        second_order(node(k), node(k - 1), node(k - 2), distance(k - 1, k), distance(k - 2, k)));
    if (closed || k + 1 < count)
      compare_with_central(node(k + 1), distance(k - 1, k), distance(k, k + 1), result.back());
  }
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
      if (surface.track->along.clockwise) std::ranges::reverse(line);
      add_line(assembly.mesh, line, lines.closed, result);
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
