#include "model/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/mesh/flat_part.hpp>
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

/// Whether a line passes through a facet at an angle of some size. From the rim of a contact it
/// runs along the sides of the body, through which no wear comes.
template <int dim>
bool passes_through(const Mesh<dim>& mesh, const typename Mesh<dim>::Facet& facet,
                    const Vector<dim>& along) {
  constexpr double least = 0.2;  // sine of the angle between them
  const Vector<dim> area = area_vector(mesh, facet);
  return std::abs(area.dot(along)) > least * area.norm() * along.norm();
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
      for (const int near : bins.near_line(from, along, far, radius)) {
        const auto& facet = boundary[static_cast<std::size_t>(near)];
        if (!passes_through(mesh, facet, along)) continue;
        for (const auto& simplex : simplices<dim>(facet)) {
          const Crossing<dim> crossing(from, along, simplex, mesh.nodes);
          const double edge = (mesh.nodes[static_cast<std::size_t>(simplex[1])] -
                               mesh.nodes[static_cast<std::size_t>(simplex[0])])
                                  .norm();
          if (crossing.shares.minCoeff() >= -rounding && crossing.distance > 1e-6 * edge)
            result[c] = std::min(result[c], crossing.distance);
        }
      }
    }
  }
  return result;
}

template std::vector<double> thickness_behind(const Assembly<2>&);
template std::vector<double> thickness_behind(const Assembly<3>&);

}  // namespace gnomon
