// The surface of a counter-body within a box, as facets: for files and figures.
#pragma once

#include <array>
#include <functional>
#include <gnomon/shapes/counter_shape.hpp>
#include <vector>

namespace gnomon {

/// Points, joined by line segments (2D) or quadrilaterals (3D). A facet has the counter-body on its
/// left (2D), or its corners are anticlockwise as seen from outside of the counter-body (3D).
template <int dim>
struct FacetedSurface {
  std::vector<Vector<dim>> points;                          ///< [length]
  std::vector<std::array<int, dim == 2 ? 2 : 4>> facets{};  ///< indices of points
};

/// A box with sides along the coordinate directions.
template <int dim>
struct Box {
  Vector<dim> low, high;  ///< [length]

  /// The smallest box around `points`, which are one or more.
  static Box around(const std::vector<Vector<dim>>& points);
  /// Wider on all sides by a part of its longest side.
  Box widened(double part) const;
  double diagonal() const { return (high - low).norm(); }
};

/// The zero level of a signed distance within a box that is divided into cells, `most` along its
/// longest side: one point per cell that the level crosses, moved onto the level along the
/// gradient; a facet where the level crosses an edge of the cells. What is thinner than a cell is
/// not seen. The distance may have no normal at some points, but has a gap everywhere.
template <int dim>
FacetedSurface<dim> zero_level(
    const std::function<SignedDistance<dim>(const Vector<dim>&)>& distance, const Box<dim>& box,
    int most);

}  // namespace gnomon
