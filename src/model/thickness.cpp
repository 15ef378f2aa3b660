#include "model/thickness.hpp"

#include <Eigen/LU>
#include <limits>

#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

template <int dim>
struct Simplex {
  std::array<Vector<dim>, dim> corners;
};

/// The facets around the cells of a body, those of its bonds among them.
template <int dim>
std::vector<Simplex<dim>> boundary_of(const Assembly<dim>& assembly, const FacetTable<dim>& facets,
                                      int body) {
  const auto at = [&](int node) { return assembly.mesh.nodes[static_cast<std::size_t>(node)]; };
  const auto body_at = [&](int slot) {
    return assembly.body_of[static_cast<std::size_t>(slot / facets.facets_per_cell)];
  };
  std::vector<Simplex<dim>> result;
  for (int slot = 0; slot < facets.slots(); ++slot) {
    const int other = facets.neighbour(slot);
    if (body_at(slot) != body || (other >= 0 && body_at(other) == body)) continue;
    const auto facet = facets.facet(slot);
    if constexpr (dim == 2) {
      result.push_back({{at(facet[0]), at(facet[1])}});
    } else {
      result.push_back({{at(facet[0]), at(facet[1]), at(facet[2])}});
      result.push_back({{at(facet[0]), at(facet[2]), at(facet[3])}});
    }
  }
  return result;
}

/// How far from a point along a unit vector; infinite where it misses.
template <int dim>
double distance_to(const Simplex<dim>& simplex, const Vector<dim>& from, const Vector<dim>& along) {
  constexpr double far = std::numeric_limits<double>::infinity(), rounding = 1e-9;
  Tensor<dim> M;  // from + t along = corner_0 + sum of shares times edges
  for (int k = 1; k < dim; ++k) M.col(k - 1) = simplex.corners[std::size_t(k)] - simplex.corners[0];
  M.col(dim - 1) = -along;
  double size = 1;
  for (int k = 0; k < dim - 1; ++k) size *= M.col(k).norm();
  if (std::abs(M.determinant()) <= rounding * size) return far;
  const Vector<dim> found = M.inverse() * (from - simplex.corners[0]);
  double rest = 1;
  for (int k = 0; k < dim - 1; ++k) {
    if (found[k] < -rounding) return far;
    rest -= found[k];
  }
  const double edge = M.col(0).norm();
  return rest >= -rounding && found[dim - 1] > 1e-6 * edge ? found[dim - 1] : far;
}

}  // namespace

template <int dim>
std::vector<double> thickness_behind(const Assembly<dim>& assembly) {
  std::vector<double> result(assembly.contact_nodes.size(),
                             std::numeric_limits<double>::infinity());
  const std::vector<int> body_of = body_of_nodes(assembly.mesh, assembly.body_of);
  const FacetTable<dim> facets(assembly.mesh);
  for (int body = 0; body < static_cast<int>(assembly.bodies.size()); ++body) {
    const std::vector<Simplex<dim>> boundary = boundary_of(assembly, facets, body);
    for (std::size_t c = 0; c < result.size(); ++c) {
      const ContactPatch<dim>& patch = assembly.contact_nodes[c];
      if (body_of[static_cast<std::size_t>(patch.node)] != body ||
          !assembly.wears(static_cast<int>(c)))
        continue;
      const Vector<dim> inwards = -patch.initial_normal.normalized();
      for (const Simplex<dim>& simplex : boundary)
        result[c] = std::min(result[c], distance_to<dim>(simplex, patch.initial_position, inwards));
    }
  }
  return result;
}

template std::vector<double> thickness_behind(const Assembly<2>&);
template std::vector<double> thickness_behind(const Assembly<3>&);

}  // namespace gnomon
