// Geometry in the plane for the mortar integrals of facets in space: quadrilaterals, and the part
// that two of them have in common, with the derivatives of its corners.
#pragma once

#include <Eigen/Core>
#include <array>

namespace gnomon::mortar {

using Point = Eigen::Vector2d;
using Shapes = Eigen::Vector4d;  ///< a value for each node of a facet
using ShapeGradient = Eigen::Matrix<double, 4, 2>;

inline double cross(const Point& a, const Point& b) {
  return a[0] * b[1] - a[1] * b[0];
}
/// Turned left by a right angle: cross(a, b) = left(a) . b.
inline Point left(const Point& a) {
  return {-a[1], a[0]};
}

/// Of the nodes, in parent coordinates.
inline const ShapeGradient corner_signs =
    (ShapeGradient() << -1, -1, 1, -1, 1, 1, -1, 1).finished();

inline Shapes shapes(const Point& xi) {
  const double l = 1 - xi[0], r = 1 + xi[0], b = 1 - xi[1], t = 1 + xi[1];
  return Shapes(l * b, r * b, r * t, l * t) / 4;
}
inline ShapeGradient shape_gradient(const Point& xi) {
  const double l = 1 - xi[0], r = 1 + xi[0], b = 1 - xi[1], t = 1 + xi[1];
  return (ShapeGradient() << -b, -l, b, -r, t, r, -t, l).finished() / 4;
}

/// A quadrilateral with bilinear coordinates; its nodes counterclockwise.
class Quadrilateral {
public:
  explicit Quadrilateral(const ShapeGradient& nodes);

  const ShapeGradient& nodes() const { return nodes_; }
  Point node(int a) const { return nodes_.row(a); }
  /// Whether the map from parent coordinates is one to one, and not only by rounding.
  bool convex() const;
  /// Whether the map is affine but for rounding.
  bool parallelogram() const { return distortion() < 1e-12; }
  /// Largest relative change of the Jacobian from the middle.
  double distortion() const { return slope_.cwiseAbs().sum() / middle_; }
  /// The Jacobian is middle + slope . xi.
  double middle() const { return middle_; }
  const Point& slope() const { return slope_; }
  double jacobian(const Point& xi) const { return middle_ + slope_.dot(xi); }
  /// Of a point in it.
  Point parent(const Point& p) const;
  /// d parent / d point.
  Eigen::Matrix2d parent_by_point(const Point& xi) const;
  /// d Jacobian / d nodes.
  ShapeGradient jacobian_by_nodes(const Point& xi) const;

private:
  Point tangent(int i, const Point& xi) const {
    return (i == 0 ? first_ : second_) + twist_ * xi[1 - i];
  }

  ShapeGradient nodes_;
  Point centre_, first_, second_, twist_;  // p = centre + first xi + second eta + twist xi eta
  double middle_;
  Point slope_;
};

/// The part of a slave that a master covers, both convex: a convex polygon.
///
/// Master nodes on an edge of the slave count as outside of it. Then pairs with a common edge of
/// the master decide alike, so that the masters of a slave leave no gap and do not overlap; where
/// the edges of both coincide, the part ends at the slave's and moves with it. The quadrilaterals
/// must outlive it.
class Overlap {
public:
  static constexpr int most_corners = 16;

  Overlap() = default;
  Overlap(const Quadrilateral& slave, const Quadrilateral& master);

  int corners() const { return count_; }
  const Point& corner(int k) const { return corners_[k].at; }
  /// The next corner, counterclockwise.
  int next(int k) const { return k + 1 == count_ ? 0 : k + 1; }
  Point mean() const;
  double area() const;

  /// Add the derivatives by the nodes of slave and master of a quantity whose derivative by a
  /// corner is given.
  template <class Gradient, class Nodal>
  void add_corner(int k, const Gradient& by_corner, Nodal& by_slave, Nodal& by_master) const;

private:
  struct Corner {
    Point at;
    int line;  ///< from this corner to the next: 0 to 3 the slave's edges, 4 to 7 the master's
  };
  static bool of_slave(int line) { return line < 4; }
  Point start(int line) const {
    return of_slave(line) ? slave_->node(line) : master_->node(line - 4);
  }
  static int next_node(int node) { return (node + 1) % 4; }
  Point end(int line) const {
    return of_slave(line) ? slave_->node(next_node(line)) : master_->node(next_node(line - 4));
  }
  void clip(int edge, double tolerance);
  Point crossing(const Corner& inside, const Corner& outside, double part, int line,
                 int edge) const;
  void push(const Point& at, int line) {
    if (count_ < most_corners) corners_[count_++] = {at, line};
  }

  const Quadrilateral *slave_ = nullptr, *master_ = nullptr;
  std::array<Corner, most_corners> corners_;
  int count_ = 0;
};

/// Integrals over the overlap of the shapes of one of its quadrilaterals, and their derivatives by
/// the corners of the overlap and by the quadrilateral's nodes.
///
/// They are sums over the edges, of integrals of polynomials along the parabola in parent
/// coordinates through the ends and the middle of the edge. So the sum over overlaps that share
/// their edges is that over the edges of the quadrilateral alone, where it is exact, whatever its
/// shape; and the sum over the nodes is the area.
struct ShapeIntegrals {
  Shapes value;
  Eigen::Matrix<double, 4, 2 * Overlap::most_corners> by_corners;
  Eigen::Matrix<double, 4, 8> by_nodes;

  ShapeIntegrals(const Quadrilateral& on, const Overlap& overlap, bool derivatives);
};

template <class Gradient, class Nodal>
void Overlap::add_corner(int k, const Gradient& by_corner, Nodal& by_slave,
                         Nodal& by_master) const {
  int first = corners_[k == 0 ? count_ - 1 : k - 1].line, second = corners_[k].line;
  const auto add = [&](int node, int line, const auto& value) {
    (of_slave(line) ? by_slave : by_master).template middleCols<2>(2 * node) += value;
  };
  if (of_slave(first) == of_slave(second)) return add(second % 4, second, by_corner);
  if (!of_slave(first)) std::swap(first, second);
  const Point a = start(first), along = end(first) - a, c = start(second), w = end(second) - c;
  const double of_first = (corner(k) - a).dot(along) / along.squaredNorm(),
               of_second = (corner(k) - c).dot(w) / w.squaredNorm();
  const Point normal = left(along).normalized();
  const double across = normal.dot(w);
  // The corner moves with the line of the master and along it so as to stay on that of the slave.
  // Lines that coincide have no crossing: then with the slave's.
  const bool crossing = std::abs(across) > 1e-8 * w.norm();
  Gradient by_slave_line = by_corner;
  if (crossing) by_slave_line = by_corner * (w / across) * normal.transpose();
  const Gradient by_master_line = by_corner - by_slave_line;
  add(first, first, (1 - of_first) * by_slave_line);
  add(next_node(first), first, of_first * by_slave_line);
  add(second - 4, second, (1 - of_second) * by_master_line);
  add(next_node(second - 4), second, of_second * by_master_line);
}

}  // namespace gnomon::mortar
