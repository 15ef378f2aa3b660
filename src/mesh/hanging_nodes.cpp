#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/import_cells.hpp"
#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

/// How near to a facet, by its size, a node hangs on it; a gap so narrow is none that was meant.
constexpr double nearness = 1e-3;

template <int dim>
Vector<dim> nearest_on_segment(const Vector<dim>& x, const Vector<dim>& a, const Vector<dim>& b) {
  const Vector<dim> along = b - a;
  return a + std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

/// Nearest point of a triangle; of its sides where the projection falls outside.
Vector<3> nearest_on_triangle(const Vector<3>& x, const std::array<Vector<3>, 3>& corners) {
  const Vector<3> a = corners[1] - corners[0], b = corners[2] - corners[0];
  const Vector<3> n = a.cross(b);
  const Vector<3> from = x - corners[0];
  const double s = from.cross(b).dot(n) / n.squaredNorm();
  const double t = a.cross(from).dot(n) / n.squaredNorm();
  if (s >= 0 && t >= 0 && s + t <= 1) return corners[0] + s * a + t * b;
  Vector<3> best = corners[0];
  for (int k = 0; k < 3; ++k) {
    const Vector<3> point = nearest_on_segment<3>(x, corners[k], corners[(k + 1) % 3]);
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

Vector<2> nearest_on_facet(const Vector<2>& x, const std::array<Vector<2>, 2>& facet) {
  return nearest_on_segment<2>(x, facet[0], facet[1]);
}

/// Of the four triangles between the centroid and the sides.
Vector<3> nearest_on_facet(const Vector<3>& x, const std::array<Vector<3>, 4>& facet) {
  const Vector<3> centre = (facet[0] + facet[1] + facet[2] + facet[3]) / 4;
  Vector<3> best = centre;
  for (int a = 0; a < 4; ++a) {
    const Vector<3> point = nearest_on_triangle(x, {centre, facet[a], facet[(a + 1) % 4]});
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

/// Nodes of the boundary, ascending in the first coordinate.
template <int dim>
std::vector<int> sorted_nodes(const ImportedBody<dim>& body) {
  std::vector<int> nodes;
  for (const auto& facet : body.exterior) nodes.insert(nodes.end(), facet.begin(), facet.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto& X = body.mesh.nodes;
  std::sort(nodes.begin(), nodes.end(),
            [&X](int a, int b) { return X[a][0] != X[b][0] ? X[a][0] < X[b][0] : a < b; });
  return nodes;
}

template <int dim>
bool hangs(const Vector<dim>& x, const typename Mesh<dim>::Facet& facet,
           const std::vector<Vector<dim>>& nodes, double margin) {
  std::array<Vector<dim>, Mesh<dim>::facet_nodes> corners;
  for (std::size_t a = 0; a < facet.size(); ++a) corners[a] = nodes[facet[a]];
  const Vector<dim> point = nearest_on_facet(x, corners);
  if ((x - point).norm() > margin) return false;
  // The next nodes along the boundary are near to a corner at most.
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector<dim>& corner) { return (point - corner).norm() > margin; });
}

}  // namespace

template <int dim>
void check_hanging_nodes(const ImportedBody<dim>& body) {
  const auto& X = body.mesh.nodes;
  const std::vector<int> nodes = sorted_nodes(body);
  for (const auto& facet : body.exterior) {
    Eigen::AlignedBox<double, dim> box;
    for (int node : facet) box.extend(X[node]);
    const double margin = nearness * box.diagonal().norm();
    box.min().array() -= margin;
    box.max().array() += margin;
    auto at = std::lower_bound(nodes.begin(), nodes.end(), box.min()[0],
                               [&X](int node, double x) { return X[node][0] < x; });
    for (; at != nodes.end() && X[*at][0] <= box.max()[0]; ++at) {
      if (!box.contains(X[*at])) continue;
      if (std::find(facet.begin(), facet.end(), *at) != facet.end()) continue;
      if (hangs<dim>(X[*at], facet, X, margin))
        refuse_body(
            body,
            fmt::format("{} hangs: it lies at {} within the side of a cell, of which it is no "
                        "corner; expected cells that meet side to side (in Gmsh: Coherence, or "
                        "BooleanFragments, before meshing)",
                        body.node_tags[*at] == 0 ? std::string("a node")
                                                 : fmt::format("node {}", body.node_tags[*at]),
                        place_text({X[*at].data(), static_cast<std::size_t>(dim)})));
    }
  }
}

template void check_hanging_nodes(const ImportedBody<2>&);
template void check_hanging_nodes(const ImportedBody<3>&);

}  // namespace gnomon
