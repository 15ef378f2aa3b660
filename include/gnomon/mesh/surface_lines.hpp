// The nodes of a surface that is uniform along straight lines or circles, on these. Straight lines
// may be a little curved, as those of a wheel that turns, where edges of the surface follow them
// from end to end.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Along which the material of a surface moves: straight lines, or circles.
template <int dim>
struct Streamlines {
  /// Direction of the lines, or axis of the circles: unit; zero for circles in the plane.
  Vector<dim> along;
  std::optional<Vector<dim>> centre{};  ///< of circles: their centre, in space a point of the axis
  bool clockwise = false;  ///< of circles in the plane: how material moves; in space about `along`

  /// From the axis of circles to a point.
  Vector<dim> radial(const Vector<dim>& x) const {
    const Vector<dim> r = x - *centre;
    return r - r.dot(along) * along;
  }
  /// Of circles, at a point: unit vectors across them, along the radius and, in space, the axis.
  Eigen::Matrix<double, dim, dim - 1> across(const Vector<dim>& x) const {
    Eigen::Matrix<double, dim, dim - 1> frame;
    frame.col(0) = radial(x).normalized();
    if constexpr (dim == 3) frame.col(1) = along;
    return frame;
  }
};

struct SurfaceLines {
  std::vector<std::vector<int>> nodes;  ///< mesh nodes of each line, from one end to the other
  /// Of every line; of curved ones that of their chords, over which they are shifted; of circles at
  /// the mean of their radii, where it is the change of their area by the radius: of straight edges
  /// between nodes at angles theta, R sin theta [length].
  double length = 0;
  double circumference = 0;  ///< of whole circles at the mean of their radii; 0: straight lines
  bool closed = false;       ///< whole circles, which have no ends
};

/// In the plane the surface is a single line. Circles may be closed. Throws InputError where a node
/// lies on no line that goes from one end of the surface to the other.
template <int dim>
SurfaceLines lines_of_surface(const Mesh<dim>& mesh,
                              const std::vector<typename Mesh<dim>::Facet>& facets,
                              const Streamlines<dim>& along);

}  // namespace gnomon
