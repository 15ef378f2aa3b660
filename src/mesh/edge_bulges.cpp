#include "mesh/edge_bulges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gnomon/mesh/flat_part.hpp>
#include <optional>

namespace gnomon {

namespace {

constexpr double cosine_of_corner = 0.87;  // of 30 degrees
constexpr double straight = 1e-5;          // of the length of an edge

/// Edges of curves, and the tangents where two of them meet smoothly.
template <int dim>
class Curves {
public:
  Curves(const Mesh<dim>& mesh, const std::vector<Edge>& edges) : mesh_(mesh) {
    for (const Edge& edge : edges)
      for (int end : {0, 1}) neighbours_[edge[end]].push_back(edge[1 - end]);
  }

  /// A unit vector of either sign; nothing at corners and ends.
  std::optional<Vector<dim>> tangent(int node) const {
    const std::vector<int>& ends = neighbours_.at(node);
    if (ends.size() != 2) return {};
    const Vector<dim> before = mesh_.nodes[node] - mesh_.nodes[ends[0]],
                      after = mesh_.nodes[ends[1]] - mesh_.nodes[node];
    if (before.normalized().dot(after.normalized()) < cosine_of_corner) return {};
    return (before / before.squaredNorm() + after / after.squaredNorm()).normalized();
  }

private:
  const Mesh<dim>& mesh_;
  std::map<int, std::vector<int>> neighbours_;
};

/// The bulge of an edge by what its direction loses in the tangent spaces at its ends.
template <int dim>
std::array<double, 3> bulge(const Vector<dim>& edge, std::optional<Vector<dim>> lost_first,
                            std::optional<Vector<dim>> lost_last) {
  const Vector<dim> along = edge.normalized();
  for (auto* lost : {&lost_first, &lost_last})
    if (*lost) **lost -= (*lost)->dot(along) * along;
  Vector<dim> result = Vector<dim>::Zero();
  if (lost_first && lost_last) {
    if (std::min(lost_first->norm(), lost_last->norm()) > straight * edge.norm())
      result = (*lost_last - *lost_first) / 8;
  } else if (lost_first) {
    result = -*lost_first / 4;
  } else if (lost_last) {
    result = *lost_last / 4;
  }
  std::array<double, 3> components{};
  std::copy_n(result.data(), dim, components.begin());
  return components;
}

template <int dim>
void add_curves(EdgeBulges& bulges, const Mesh<dim>& mesh, const std::vector<Edge>& edges) {
  const Curves<dim> curves(mesh, edges);
  for (const Edge& edge : edges) {
    const Vector<dim> along = mesh.nodes[edge[1]] - mesh.nodes[edge[0]];
    const auto lost = [&](int node) -> std::optional<Vector<dim>> {
      const auto tangent = curves.tangent(node);
      if (!tangent) return {};
      return along - along.dot(*tangent) * *tangent;
    };
    bulges[edge] = bulge<dim>(along, lost(edge[0]), lost(edge[1]));
  }
}

/// Edges of the facets, with the unit normals on their sides.
std::map<Edge, std::vector<Vector<3>>> sides_of_edges(const Mesh<3>& mesh,
                                                      const std::vector<Mesh<3>::Facet>& exterior) {
  std::map<Edge, std::vector<Vector<3>>> sides;
  for (const auto& facet : exterior) {
    const Vector<3> normal = area_vector(mesh, facet).normalized();
    for (int a = 0; a < 4; ++a) sides[edge_of(facet[a], facet[(a + 1) % 4])].push_back(normal);
  }
  return sides;
}

/// Normals at nodes, by the weights that are exact on spheres.
std::map<int, Vector<3>> normals_at_nodes(const Mesh<3>& mesh,
                                          const std::vector<Mesh<3>::Facet>& exterior) {
  std::map<int, Vector<3>> normals;
  for (const auto& facet : exterior)
    for (int a = 0; a < 4; ++a) {
      const Vector<3>& place = mesh.nodes[facet[a]];
      const Vector<3> next = mesh.nodes[facet[(a + 1) % 4]] - place,
                      previous = mesh.nodes[facet[(a + 3) % 4]] - place;
      normals.try_emplace(facet[a], Vector<3>::Zero()).first->second +=
          next.cross(previous) / (next.squaredNorm() * previous.squaredNorm());
    }
  for (auto& [node, normal] : normals) normal.normalize();
  return normals;
}

}  // namespace

template <>
EdgeBulges edge_bulges(const Mesh<2>& mesh, const std::vector<Mesh<2>::Facet>& exterior) {
  std::vector<Edge> edges;
  for (const auto& facet : exterior) edges.push_back(edge_of(facet[0], facet[1]));
  EdgeBulges bulges;
  add_curves<2>(bulges, mesh, edges);
  return bulges;
}

template <>
EdgeBulges edge_bulges(const Mesh<3>& mesh, const std::vector<Mesh<3>::Facet>& exterior) {
  const auto sides = sides_of_edges(mesh, exterior);
  std::vector<Edge> creases, smooth;
  std::vector<char> creased(mesh.nodes.size(), 0);
  for (const auto& [edge, normals] : sides) {
    const bool crease = normals.size() != 2 || normals[0].dot(normals[1]) < cosine_of_corner;
    (crease ? creases : smooth).push_back(edge);
    if (crease) creased[edge[0]] = creased[edge[1]] = 1;
  }
  EdgeBulges bulges;
  add_curves<3>(bulges, mesh, creases);
  const auto normals = normals_at_nodes(mesh, exterior);
  for (const Edge& edge : smooth) {
    const Vector<3> along = mesh.nodes[edge[1]] - mesh.nodes[edge[0]];
    const auto lost = [&](int node) -> std::optional<Vector<3>> {
      if (creased[node]) return {};
      const Vector<3>& normal = normals.at(node);
      return Vector<3>(along.dot(normal) * normal);
    };
    bulges[edge] = bulge<3>(along, lost(edge[0]), lost(edge[1]));
  }
  return bulges;
}

}  // namespace gnomon
