#include "mesh/round_facets.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <span>

#include "mesh/edge_bulges.hpp"

namespace gnomon {

namespace {

using Vector3 = Eigen::Vector3d;

Vector3 place(const ImportedMesh& mesh, int node) {
  return Vector3::Map(mesh.nodes[static_cast<std::size_t>(node)].data());
}

Vector3 middle_of(const ImportedMesh& mesh, std::span<const int> nodes) {
  Vector3 sum = Vector3::Zero();
  for (const int node : nodes) sum += place(mesh, node);
  return sum / static_cast<double>(nodes.size());
}

/// Its area, in the plane the length, along its normal out of the cell.
Vector3 area_of(const ImportedMesh& mesh, const std::vector<int>& facet, int cell) {
  const Vector3 outwards = middle_of(mesh, facet) - middle_of(mesh, mesh.cells.at(cell)),
                origin = place(mesh, facet[0]), edge = place(mesh, facet[1]) - origin;
  if (facet.size() == 2)
    return (outwards - outwards.dot(edge) / edge.squaredNorm() * edge).normalized() * edge.norm();
  Vector3 area = Vector3::Zero();
  for (std::size_t a = 1; a + 1 < facet.size(); ++a)
    area += (place(mesh, facet[a]) - origin).cross(place(mesh, facet[a + 1]) - origin) / 2;
  return area.dot(outwards) < 0 ? Vector3(-area) : area;
}

/// The mean of a surface over a facet, as a quadratic element has it: a third of what each edge
/// bulges, of which a facet in the plane has one, there and back.
Vector3 mean_bulge(const EdgeBulges& bulges, const std::vector<int>& facet) {
  Vector3 mean = Vector3::Zero();
  for (std::size_t a = 0; a < facet.size(); ++a) {
    const Edge edge = edge_of(facet[a], facet[(a + 1) % facet.size()]);
    if (const auto found = bulges.find(edge); found != bulges.end())
      mean += Vector3::Map(found->second.data()) / 3;
  }
  return mean;
}

}  // namespace

std::vector<RoundFacet> round_facets(const ImportedMesh& mesh) {
  constexpr double flat = 1e-6;  // of the size of the facet
  const EdgeBulges bulges = edge_bulges(mesh);
  std::vector<RoundFacet> result;
  for (const auto& [nodes, cell] : outer_facets(mesh)) {
    const Vector3 area = area_of(mesh, nodes, cell);
    const double outside = mean_bulge(bulges, nodes).dot(area.normalized()),
                 size = (place(mesh, nodes[1]) - place(mesh, nodes[0])).norm();
    if (std::abs(outside) > flat * size)
      result.push_back({.nodes = nodes, .area = area.norm(), .outside = outside});
  }
  return result;
}

}  // namespace gnomon
