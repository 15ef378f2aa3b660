#include "model/thickness.hpp"

#include <Eigen/LU>
#include <array>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>

#include "mesh/facet_bins.hpp"
#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

template <int dim>
using Simplex = std::array<Vector<dim>, dim>;

/// The facets around the cells of a body, those of its bonds among them.
template <int dim>
std::vector<typename Mesh<dim>::Facet> boundary_of(const Assembly<dim>& assembly,
                                                   const FacetTable<dim>& facets, int body) {
  const auto body_at = [&](int slot) {
    return assembly.body_of[static_cast<std::size_t>(slot / facets.facets_per_cell)];
  };
  std::vector<typename Mesh<dim>::Facet> result;
  for (int slot = 0; slot < facets.slots(); ++slot) {
    const int other = facets.neighbour(slot);
    if (body_at(slot) == body && (other < 0 || body_at(other) != body))
      result.push_back(facets.facet(slot));
  }
  return result;
}

template <int dim>
std::vector<Simplex<dim>> simplices_of(const Mesh<dim>& mesh,
                                       const typename Mesh<dim>::Facet& facet) {
  const auto at = [&](int a) { return mesh.nodes[static_cast<std::size_t>(facet[a])]; };
  if constexpr (dim == 2)
    return {{at(0), at(1)}};
  else
    return {{at(0), at(1), at(2)}, {at(0), at(2), at(3)}};
}

/// How far from a point along a unit vector; infinite where it misses.
template <int dim>
double distance_to(const Simplex<dim>& simplex, const Vector<dim>& from, const Vector<dim>& along) {
  constexpr double far = std::numeric_limits<double>::infinity(), rounding = 1e-9;
  Tensor<dim> M;  // from + t along = corner_0 + sum of shares times edges
  for (int k = 1; k < dim; ++k) M.col(k - 1) = simplex[std::size_t(k)] - simplex[0];
  M.col(dim - 1) = -along;
  double size = 1;
  for (int k = 0; k < dim - 1; ++k) size *= M.col(k).norm();
  if (std::abs(M.determinant()) <= rounding * size) return far;
  const Vector<dim> found = M.inverse() * (from - simplex[0]);
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
  constexpr double far = std::numeric_limits<double>::infinity(), rounding = 1e-9;
  const Mesh<dim>& mesh = assembly.mesh;
  std::vector<double> result(assembly.contact_nodes.size(), far);
  const std::vector<int> body_of = body_of_nodes(mesh, assembly.body_of);
  const FacetTable<dim> facets(mesh);
  const Box<dim> box = Box<dim>::around(mesh.nodes);
  const double radius = rounding * (box.high - box.low).norm();
  for (int body = 0; body < static_cast<int>(assembly.bodies.size()); ++body) {
    const auto boundary = boundary_of(assembly, facets, body);
    const FacetBins<dim> bins(boundary, mesh.nodes);
    for (std::size_t c = 0; c < result.size(); ++c) {
      const ContactPatch<dim>& patch = assembly.contact_nodes[c];
      if (body_of[static_cast<std::size_t>(patch.node)] != body ||
          !assembly.wears(static_cast<int>(c)))
        continue;
      const Vector<dim> from = patch.initial_position, along = -patch.initial_normal.normalized();
      for (const int facet : bins.near_line(from, along, far, radius))
        for (const auto& simplex : simplices_of<dim>(mesh, boundary[std::size_t(facet)]))
          result[c] = std::min(result[c], distance_to<dim>(simplex, from, along));
    }
  }
  return result;
}

template std::vector<double> thickness_behind(const Assembly<2>&);
template std::vector<double> thickness_behind(const Assembly<3>&);

}  // namespace gnomon
