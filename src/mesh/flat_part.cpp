#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gnomon/mesh/flat_part.hpp>

namespace gnomon {

Vector<2> area_vector(const Mesh<2>& mesh, const Mesh<2>::Facet& facet) {
  const Vector<2> along = mesh.nodes[facet[1]] - mesh.nodes[facet[0]];
  return {along[1], -along[0]};
}

Vector<3> area_vector(const Mesh<3>& mesh, const Mesh<3>::Facet& facet) {
  const auto& X = mesh.nodes;
  return (X[facet[2]] - X[facet[0]]).cross(X[facet[3]] - X[facet[1]]) / 2;
}

template <int dim>
FlatPart<dim> flat_part(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                        double tolerance) {
  FlatPart<dim> part;
  if (facets.empty()) return part;
  const Vector<dim> origin = mesh.nodes[facets[0][0]];
  Vector<dim> middle = Vector<dim>::Zero(), total = Vector<dim>::Zero();
  Eigen::AlignedBox<double, dim> box;
  double area = 0;
  for (const auto& facet : facets) {
    const Vector<dim> own = area_vector(mesh, facet);
    Vector<dim> centre = Vector<dim>::Zero();
    for (int node : facet) {
      centre += (mesh.nodes[node] - origin) / static_cast<double>(facet.size());
      box.extend(mesh.nodes[node]);
    }
    total += own;
    middle += own.norm() * centre;
    area += own.norm();
  }
  if (!(total.norm() > 1e-12 * area)) return part;  // closed
  middle = origin + middle / area;
  part.normal = total.normalized();
  const double size = box.diagonal().norm();
  bool same_way = true;
  for (const auto& facet : facets) {
    same_way = same_way && area_vector(mesh, facet).dot(part.normal) > 0;
    for (int node : facet)
      part.deviation =
          std::max(part.deviation, std::abs((mesh.nodes[node] - middle).dot(part.normal)) / size);
  }
  part.flat = same_way && part.deviation < tolerance;
  return part;
}

template <int dim>
int planes_of(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
              double tolerance) {
  struct Plane {
    Vector<dim> normal, point;
  };
  constexpr std::size_t most = 6;
  constexpr double cosine = 0.87;  // of 30 degrees
  Eigen::AlignedBox<double, dim> box;
  for (const auto& facet : facets)
    for (int node : facet) box.extend(mesh.nodes[node]);
  std::vector<Plane> planes;
  for (const auto& facet : facets) {
    const Vector<dim> normal = area_vector(mesh, facet).normalized(), point = mesh.nodes[facet[0]];
    const auto known = std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) {
      return (normal - plane.normal).norm() < tolerance &&
             std::abs((point - plane.point).dot(plane.normal)) < tolerance * box.diagonal().norm();
    });
    if (known != planes.end()) continue;
    for (const Plane& plane : planes)
      if (normal.dot(plane.normal) > cosine && (normal - plane.normal).norm() >= tolerance)
        return 0;
    planes.push_back({normal, point});
    if (planes.size() > most) return 0;
  }
  return static_cast<int>(planes.size());
}

template int planes_of(const Mesh<2>&, const std::vector<Mesh<2>::Facet>&, double);
template int planes_of(const Mesh<3>&, const std::vector<Mesh<3>::Facet>&, double);
template FlatPart<2> flat_part(const Mesh<2>&, const std::vector<Mesh<2>::Facet>&, double);
template FlatPart<3> flat_part(const Mesh<3>&, const std::vector<Mesh<3>::Facet>&, double);

}  // namespace gnomon
