// Where lines meet the planes of facets.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <limits>

namespace gnomon {

/// The simplices of a facet: itself, or two triangles.
template <int dim>
std::vector<std::array<int, dim>> simplices(const typename Mesh<dim>::Facet& facet);

/// Where the line from a point along e meets the plane of a simplex.
template <int dim>
struct Crossing {
  double distance =
      std::numeric_limits<double>::infinity();  ///< negative behind the point [length]
  /// Of the corners, of sum 1; negative ones: it passes by.
  Vector<dim> shares = Vector<dim>::Constant(-1);

  Crossing(const Vector<dim>& point, const Vector<dim>& e, const std::array<int, dim>& simplex,
           const std::vector<Vector<dim>>& x);
};

}  // namespace gnomon
