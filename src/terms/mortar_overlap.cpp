#include "terms/mortar_overlap.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace gnomon::mortar {

Quadrilateral::Quadrilateral(const ShapeGradient& nodes) : nodes_(nodes) {
  const auto sum = [&](const Shapes& signs) -> Point { return nodes.transpose() * signs / 4; };
  centre_ = sum(Shapes::Ones());
  first_ = sum(corner_signs.col(0));
  second_ = sum(corner_signs.col(1));
  twist_ = sum(corner_signs.col(0).cwiseProduct(corner_signs.col(1)));
  middle_ = cross(first_, second_);
  slope_ = {cross(first_, twist_), cross(twist_, second_)};
}

bool Quadrilateral::convex() const {
  const Shapes at_corners = (corner_signs * slope_).array() + middle_;
  return at_corners.minCoeff() > 1e-6 * at_corners.maxCoeff();
}

Point Quadrilateral::parent(const Point& p) const {
  // Each coordinate solves a quadratic equation with the same discriminant: the Jacobian at p,
  // squared. In this form nothing cancels in a convex quadrilateral, nor if the twist vanishes.
  const Point q = p - centre_;
  const double turn = cross(q, twist_), c = cross(q, second_), b = middle_ - turn;
  const double J = std::sqrt(std::max(0.0, b * b + 4 * slope_[0] * c));
  return {2 * c / (b + J), -2 * cross(q, first_) / (middle_ + turn + J)};
}

Eigen::Matrix2d Quadrilateral::parent_by_point(const Point& xi) const {
  const Point g1 = tangent(0, xi), g2 = tangent(1, xi);
  return (Eigen::Matrix2d() << g2[1], -g2[0], -g1[1], g1[0]).finished() / cross(g1, g2);
}

ShapeGradient Quadrilateral::jacobian_by_nodes(const Point& xi) const {
  const ShapeGradient gradient = shape_gradient(xi);
  return gradient.col(1) * left(tangent(0, xi)).transpose() -
         gradient.col(0) * left(tangent(1, xi)).transpose();
}

Overlap::Overlap(const Quadrilateral& slave, const Quadrilateral& master)
    : slave_(&slave), master_(&master) {
  for (int b = 0; b < 4; ++b) push(master.node(b), 4 + b);
  const double tolerance = 1e-12 * std::sqrt(slave.middle());
  for (int edge = 0; edge < 4; ++edge) clip(edge, tolerance);
}

void Overlap::clip(int edge, double tolerance) {
  const Point origin = start(edge), inwards = left(end(edge) - origin).normalized();
  const std::array<Corner, most_corners> old = corners_;
  std::array<double, most_corners> depth;
  const int count = count_;
  for (int k = 0; k < count; ++k) depth[k] = inwards.dot(old[k].at - origin);
  count_ = 0;
  for (int k = 0; k < count; ++k) {
    const int l = k + 1 == count ? 0 : k + 1;
    const bool from_inside = depth[k] > tolerance, to_inside = depth[l] > tolerance;
    if (from_inside) push(old[k].at, old[k].line);
    if (from_inside == to_inside) continue;
    const int in = from_inside ? k : l, out = from_inside ? l : k;
    const double part = std::min(1.0, depth[in] / (depth[in] - depth[out]));
    push(crossing(old[in], old[out], part, old[k].line, edge), from_inside ? edge : old[k].line);
  }
}

/// Of a line with an edge of the slave. It is reckoned from the inside, so that masters on both
/// sides of the line find the same point.
Point Overlap::crossing(const Corner& inside, const Corner& outside, double part, int line,
                        int edge) const {
  if (line == next_node(edge)) return slave_->node(line);
  if (of_slave(line) && next_node(line) == edge) return slave_->node(edge);
  return inside.at + part * (outside.at - inside.at);
}

Point Overlap::mean() const {
  Point sum = Point::Zero();
  for (int k = 0; k < count_; ++k) sum += corner(k);
  return sum / count_;
}

double Overlap::area() const {
  double twice = 0;
  for (int k = 2; k < count_; ++k) twice += cross(corner(k - 1) - corner(0), corner(k) - corner(0));
  return twice / 2;
}

namespace {

/// int_0^1 N_a(r xi) J(r xi) r dr, J = middle + slope . xi, and its derivatives: a form
/// (...) xi x dxi with this factor has the derivative N_a J dxi deta.
struct RadialIntegral {
  Shapes value;
  ShapeGradient by_xi;
  Eigen::Matrix<double, 4, 3> by_jacobian;  ///< by middle and slope

  RadialIntegral(const Quadrilateral& on, const Point& xi) {
    const Shapes linear = corner_signs * xi,
                 twist = corner_signs.col(0).cwiseProduct(corner_signs.col(1));
    const double both = xi[0] * xi[1], change = on.slope().dot(xi);
    const Shapes constant = (0.5 + (linear / 3 + both * twist / 4).array()) / 4,
                 sloping = (1.0 / 3 + (linear / 4 + both * twist / 5).array()) / 4;
    value = on.middle() * constant + change * sloping;
    by_jacobian << constant, sloping * xi.transpose();
    by_xi = (on.middle() / 12 + change / 16) * corner_signs + sloping * on.slope().transpose();
    by_xi += (on.middle() / 16 + change / 20) * twist * Eigen::RowVector2d(xi[1], xi[0]);
  }
};

/// A point of a parabola in parent coordinates, of its three points: weights of their values, and
/// of their tangents.
struct PathPoint {
  double weight;
  std::array<double, 3> at, tangent;

  PathPoint(double t, double w)
      : weight(w),
        at{(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)},
        tangent{4 * t - 3, 4 - 8 * t, 4 * t - 1} {}
};
const std::array<PathPoint, 3> path_points = {PathPoint(0.5 - std::sqrt(0.15), 5.0 / 18),
                                              PathPoint(0.5, 8.0 / 18),
                                              PathPoint(0.5 + std::sqrt(0.15), 5.0 / 18)};

/// The integral along one edge, by its three points in parent coordinates and by the Jacobian.
struct EdgeIntegral {
  Shapes value = Shapes::Zero();
  std::array<ShapeGradient, 3> by_points = {ShapeGradient::Zero(), ShapeGradient::Zero(),
                                            ShapeGradient::Zero()};
  Eigen::Matrix<double, 4, 3> by_jacobian = Eigen::Matrix<double, 4, 3>::Zero();

  EdgeIntegral(const Quadrilateral& on, const std::array<Point, 3>& points, bool derivatives) {
    for (const PathPoint& path : path_points) {
      Point xi = Point::Zero(), tangent = Point::Zero();
      for (int k = 0; k < 3; ++k)
        xi += path.at[k] * points[k], tangent += path.tangent[k] * points[k];
      const RadialIntegral radial(on, xi);
      const double turn = path.weight * cross(xi, tangent);
      value += turn * radial.value;
      if (!derivatives) continue;
      const Shapes weighted = path.weight * radial.value;
      const ShapeGradient by_xi = turn * radial.by_xi - weighted * left(tangent).transpose(),
                          by_tangent = weighted * left(xi).transpose();
      for (int k = 0; k < 3; ++k) by_points[k] += path.at[k] * by_xi + path.tangent[k] * by_tangent;
      by_jacobian += turn * radial.by_jacobian;
    }
  }
};

/// Without the mean over the nodes.
template <class Nodal>
void remove_mean(Nodal& nodal) {
  nodal.rowwise() -= nodal.colwise().mean().eval();
}

}  // namespace

ShapeIntegrals::ShapeIntegrals(const Quadrilateral& on, const Overlap& overlap, bool derivatives) {
  const int count = overlap.corners();
  value.setZero();
  by_corners.setZero();
  by_nodes.setZero();
  Eigen::Matrix<double, 4, 3> by_jacobian = Eigen::Matrix<double, 4, 3>::Zero();
  const auto add = [&](const ShapeGradient& by_parent, const Point& xi, double part, Eigen::Index k,
                       Eigen::Index l) {
    const ShapeGradient by_point = by_parent * on.parent_by_point(xi);
    const Shapes N = shapes(xi);
    by_corners.middleCols<2>(2 * k) += (1 - part) * by_point;
    by_corners.middleCols<2>(2 * l) += part * by_point;
    for (Eigen::Index b = 0; b < 4; ++b) by_nodes.middleCols<2>(2 * b) -= N[b] * by_point;
  };
  Point from = on.parent(overlap.corner(0));
  for (int k = 0; k < count; ++k) {
    const int l = overlap.next(k);
    const std::array<Point, 3> points = {
        from, on.parent((overlap.corner(k) + overlap.corner(l)) / 2), on.parent(overlap.corner(l))};
    const EdgeIntegral edge(on, points, derivatives);
    value += edge.value;
    from = points[2];
    if (!derivatives) continue;
    for (int i = 0; i < 3; ++i) add(edge.by_points[i], points[i], i / 2.0, k, l);
    by_jacobian += edge.by_jacobian;
  }
  remove_mean(value);
  value.array() += overlap.area() / 4;
  if (!derivatives) return;
  const ShapeGradient middle = on.jacobian_by_nodes(Point::Zero());
  const std::array<ShapeGradient, 3> by = {middle, on.jacobian_by_nodes(Point::UnitX()) - middle,
                                           on.jacobian_by_nodes(Point::UnitY()) - middle};
  for (Eigen::Index b = 0; b < 4; ++b)
    for (int i = 0; i < 3; ++i) by_nodes.middleCols<2>(2 * b) += by_jacobian.col(i) * by[i].row(b);
  remove_mean(by_corners);
  remove_mean(by_nodes);
  for (int k = 0; k < count; ++k) {
    const int l = overlap.next(k), before = k == 0 ? count - 1 : k - 1;
    const Point by_corner = -left(overlap.corner(l) - overlap.corner(before)) / 2;
    by_corners.middleCols<2>(2 * Eigen::Index{k}).rowwise() += by_corner.transpose() / 4;
  }
}

}  // namespace gnomon::mortar
