#include "model/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>

#include "mesh/crossing.hpp"
#include "mesh/facet_bins.hpp"
#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

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

/// Whether a line passes through the plane of a simplex at an angle of some size. From the rim of a
/// contact it runs along the sides of the body, through which no wear comes.
template <int dim>
bool passes_through(const std::array<int, dim>& simplex, const Vector<dim>& along,
                    const std::vector<Vector<dim>>& nodes) {
  constexpr double least = 0.2;  // sine of the angle between them
  const auto edge = [&](int k) -> Vector<dim> {
    return nodes[static_cast<std::size_t>(simplex[static_cast<std::size_t>(k)])] -
           nodes[static_cast<std::size_t>(simplex[0])];
  };
  Vector<dim> normal;
  if constexpr (dim == 2)
    normal << -edge(1)[1], edge(1)[0];
  else
    normal = edge(1).cross(edge(2));
  return std::abs(normal.dot(along)) > least * normal.norm() * along.norm();
}

}  // namespace

template <int dim>
std::vector<double> thickness_behind(const Assembly<dim>& assembly) {
  constexpr double far = std::numeric_limits<double>::infinity(), rounding = 1e-9;
  const Mesh<dim>& mesh = assembly.mesh;
  std::vector<double> result(assembly.contact_nodes.size(), far);
  const std::vector<int> body_of = body_of_nodes(mesh, assembly.body_of);
  const FacetTable<dim> facets(mesh);
  const double radius = rounding * Box<dim>::around(mesh.nodes).diagonal();
  for (int body = 0; body < static_cast<int>(assembly.bodies.size()); ++body) {
    const auto boundary = boundary_of(assembly, facets, body);
    const FacetBins<dim> bins(boundary, mesh.nodes);
    for (std::size_t c = 0; c < result.size(); ++c) {
      const ContactPatch<dim>& patch = assembly.contact_nodes[c];
      if (body_of[static_cast<std::size_t>(patch.node)] != body ||
          !assembly.wears(static_cast<int>(c)))
        continue;
      const Vector<dim> from = patch.initial_position, along = -patch.initial_normal;
      for (const int facet : bins.near_line(from, along, far, radius))
        for (const auto& simplex : simplices<dim>(boundary[static_cast<std::size_t>(facet)])) {
          if (!passes_through<dim>(simplex, along, mesh.nodes)) continue;
          const Crossing<dim> crossing(from, along, simplex, mesh.nodes);
          const double edge = (mesh.nodes[static_cast<std::size_t>(simplex[1])] -
                               mesh.nodes[static_cast<std::size_t>(simplex[0])])
                                  .norm();
          if (crossing.shares.minCoeff() >= -rounding && crossing.distance > 1e-6 * edge)
            result[c] = std::min(result[c], crossing.distance);
        }
    }
  }
  return result;
}

template std::vector<double> thickness_behind(const Assembly<2>&);
template std::vector<double> thickness_behind(const Assembly<3>&);

}  // namespace gnomon
