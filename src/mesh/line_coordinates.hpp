// Coordinates along and across the lines of a surface, all of them lengths.
#pragma once

#include <cmath>
#include <gnomon/mesh/surface_lines.hpp>
#include <vector>

namespace gnomon {

template <int dim>
class LineCoordinates {
public:
  /// `points`: of the surface; `lines` must outlive the object.
  LineCoordinates(const Streamlines<dim>& lines, const std::vector<Vector<dim>>& points);
  /// On circles, whose places begin here.
  void begin_at(const Vector<dim>& x) { first_ = x; }

  /// On circles the angle times their mean radius.
  double place(const Vector<dim>& x) const;
  /// The same for all points of a line.
  Vector<dim> across(const Vector<dim>& x) const;
  bool is_on_axis(const Vector<dim>& x) const;
  double circumference() const { return 2 * M_PI * radius_; }
  /// SurfaceLines::length of a circle.
  double length_of(const std::vector<Vector<dim>>& circle, bool closed) const;

private:
  /// The sine of the angle between two radii, times their lengths.
  double turned(const Vector<dim>& from, const Vector<dim>& to) const;

  const Streamlines<dim>& lines_;
  Vector<dim> first_;
  double radius_ = 0;
};

}  // namespace gnomon
