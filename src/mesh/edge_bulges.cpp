#include "mesh/edge_bulges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/cell_faces.hpp"

namespace gnomon {

namespace {

using Vector3 = Eigen::Vector3d;
using Polygon = std::vector<int>;

constexpr double cosine_of_corner = 0.766;  // of 40 degrees
constexpr double straight = 1e-5;           // of the length of an edge

Vector3 place(const ImportedMesh& mesh, int node) {
  return Vector3::Map(mesh.nodes[static_cast<std::size_t>(node)].data());
}

/// The groups of cells that each cell belongs to.
std::vector<std::vector<int>> groups_of_cells(const ImportedMesh& mesh) {
  std::vector<std::vector<int>> groups(static_cast<std::size_t>(mesh.cells.size()));
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    if (mesh.groups[g].dimension == mesh.dimension)
      for (const int cell : mesh.groups[g].members) groups[cell].push_back(static_cast<int>(g));
  return groups;
}

}  // namespace

std::vector<std::pair<Polygon, int>> outer_facets(const ImportedMesh& mesh) {
  // Inner ones are erased as soon as both sides are known: there are far more of them.
  std::map<Polygon, std::pair<Polygon, int>> open;
  const auto groups = groups_of_cells(mesh);
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for (const Polygon& facet : facets_of(mesh.cells.kinds[cell], mesh.cells.at(cell))) {
      Polygon key = facet;
      std::ranges::sort(key);
      const auto [at, is_new] = open.try_emplace(std::move(key), facet, cell);
      if (!is_new && groups[at->second.second] == groups[cell]) open.erase(at);
    }
  std::vector<std::pair<Polygon, int>> outer;
  for (const auto& [key, facet] : open) outer.push_back(facet);
  return outer;
}

namespace {

/// Edges of curves, and the tangents where two of them meet smoothly.
class Curves {
public:
  Curves(const ImportedMesh& mesh, const std::vector<Edge>& edges) : mesh_(mesh) {
    for (const Edge& edge : edges)
      for (int end : {0, 1}) neighbours_[edge[end]].push_back(edge[1 - end]);
  }

  /// A unit vector of either sign; nothing at corners and ends.
  std::optional<Vector3> tangent(int node) const {
    const std::vector<int>& ends = neighbours_.at(node);
    if (ends.size() != 2) return {};
    const Vector3 before = place(mesh_, node) - place(mesh_, ends[0]),
                  after = place(mesh_, ends[1]) - place(mesh_, node);
    if (before.normalized().dot(after.normalized()) < cosine_of_corner) return {};
    return (before / before.squaredNorm() + after / after.squaredNorm()).normalized();
  }

private:
  const ImportedMesh& mesh_;
  std::map<int, std::vector<int>> neighbours_;
};

/// The tangent of the cubic at an end of an edge, across the edge. `tangent` of either sign.
Vector3 rise(const Vector3& edge, const Vector3& tangent) {
  const double length = edge.norm(), cosine = std::abs(tangent.dot(edge)) / length;
  const Vector3 whole = std::copysign(2 * length / (1 + cosine), tangent.dot(edge)) * tangent;
  return whole - whole.dot(edge) / edge.squaredNorm() * edge;
}

/// From the tangents at the ends, where they are known.
std::array<double, 3> bulge(const Vector3& edge, const std::optional<Vector3>& first,
                            const std::optional<Vector3>& last) {
  Vector3 result = Vector3::Zero();
  if (first && last) {
    const Vector3 begin = rise(edge, *first), end = rise(edge, *last);
    if (std::min(begin.norm(), end.norm()) > straight * edge.norm()) result = (begin - end) / 8;
  } else if (first) {
    result = rise(edge, *first) / 4;
  } else if (last) {
    result = -rise(edge, *last) / 4;
  }
  return {result[0], result[1], result[2]};
}

void add_curves(EdgeBulges& bulges, const ImportedMesh& mesh, const std::vector<Edge>& edges) {
  const Curves curves(mesh, edges);
  for (const Edge& edge : edges)
    bulges[edge] = bulge(place(mesh, edge[1]) - place(mesh, edge[0]), curves.tangent(edge[0]),
                         curves.tangent(edge[1]));
}

/// Of facets in space; normals point out of their cells.
struct Surface {
  std::map<Edge, std::vector<Vector3>> sides;  ///< unit normals on the sides of each edge
  std::map<int, Vector3> normals;              ///< at nodes, by weights that are exact on spheres
};

Vector3 middle_of(const ImportedMesh& mesh, std::span<const int> nodes) {
  Vector3 sum = Vector3::Zero();
  for (const int node : nodes) sum += place(mesh, node);
  return sum / static_cast<double>(nodes.size());
}

Surface surface_of(const ImportedMesh& mesh) {
  Surface surface;
  for (auto& [facet, cell] : outer_facets(mesh)) {
    const std::size_t count = facet.size();
    const Vector3 origin = place(mesh, facet[0]);
    Vector3 area = Vector3::Zero();
    for (std::size_t a = 1; a + 1 < count; ++a)
      area += (place(mesh, facet[a]) - origin).cross(place(mesh, facet[a + 1]) - origin);
    const Vector3 outwards = middle_of(mesh, facet) - middle_of(mesh, mesh.cells.at(cell));
    const double sign = area.dot(outwards) < 0 ? -1 : 1;
    for (std::size_t a = 0; a < count; ++a) {
      const int node = facet[a];
      surface.sides[edge_of(node, facet[(a + 1) % count])].push_back(sign * area.normalized());
      const Vector3 next = place(mesh, facet[(a + 1) % count]) - place(mesh, node),
                    previous = place(mesh, facet[(a + count - 1) % count]) - place(mesh, node);
      surface.normals.try_emplace(node, Vector3::Zero()).first->second +=
          sign * next.cross(previous) / (next.squaredNorm() * previous.squaredNorm());
    }
  }
  return surface;
}

EdgeBulges bulges_in_plane(const ImportedMesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& [facet, cell] : outer_facets(mesh)) edges.push_back(edge_of(facet[0], facet[1]));
  EdgeBulges bulges;
  add_curves(bulges, mesh, edges);
  return bulges;
}

}  // namespace

EdgeBulges edge_bulges(const ImportedMesh& mesh) {
  if (mesh.dimension == 2) return bulges_in_plane(mesh);
  const Surface surface = surface_of(mesh);
  std::vector<Edge> creases, smooth;
  std::vector<char> creased(mesh.nodes.size(), 0);
  for (const auto& [edge, normals] : surface.sides) {
    const bool crease = normals.size() != 2 || normals[0].dot(normals[1]) < cosine_of_corner;
    (crease ? creases : smooth).push_back(edge);
    if (crease) creased[edge[0]] = creased[edge[1]] = 1;
  }
  EdgeBulges bulges;
  add_curves(bulges, mesh, creases);
  for (const Edge& edge : smooth) {
    const Vector3 along = place(mesh, edge[1]) - place(mesh, edge[0]);
    const auto tangent = [&](int node) -> std::optional<Vector3> {
      if (creased[node]) return {};
      const Vector3 normal = surface.normals.at(node).normalized();
      return Vector3((along - along.dot(normal) * normal).normalized());
    };
    bulges[edge] = bulge(along, tangent(edge[0]), tangent(edge[1]));
  }
  return bulges;
}

}  // namespace gnomon
