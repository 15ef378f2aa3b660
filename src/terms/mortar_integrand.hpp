// Two facets in space seen in one plane, and the integrands of their mortar integrals.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/terms/mortar_kernel.hpp>

#include "terms/mortar_overlap.hpp"

namespace gnomon::mortar {

// What is integrated at once: the values of a CoveredPart (the mass once for each pair of nodes),
// then the first moments that need a correction, of phi and of N over the plane.
inline constexpr int coupling_0 = 10, gap_0 = 26, values = 30, sums = 38;
/// Of the mass of a pair of nodes.
constexpr int mass_row(int a, int b) {
  const int first = std::max(a, b), second = std::min(a, b);
  return first * (first + 1) / 2 + second;
}
/// Of the coupling with a node in the master's own order.
constexpr int coupling_row(int a, int b) {
  return coupling_0 + a + 4 * b;
}
using Sums = Eigen::Matrix<double, sums, 1>;
using SumsGradient = Eigen::Matrix<double, sums, 2>;
using SumsByNodes = Eigen::Matrix<double, sums, 8>;
using ByNodes = Eigen::Matrix<double, 4, 3>;  ///< of a value, by positions or normals of nodes

/// The master's nodes turn clockwise for one who looks along its partner's: in this order
/// counterclockwise.
inline constexpr std::array<int, 4> reversed = {0, 3, 2, 1};

/// Places in the plane across n, and heights along n.
struct Frame {
  Eigen::Matrix<double, 2, 3> axes;
  Vector<3> n, origin;
  double length;  ///< of the sum of the nodal normals

  explicit Frame(const FacetPair<3>& pair) {
    const Vector<3> sum = pair.n.colwise().sum();
    length = sum.norm();
    n = is_valid() ? Vector<3>(sum / length) : Vector<3>(Vector<3>::UnitZ());
    origin = pair.x.colwise().mean();
    // Any axes will do: nothing depends on how they turn in the plane.
    const Vector<3> first = n.unitOrthogonal();
    axes << first.transpose(), n.cross(first).transpose();
  }
  bool is_valid() const { return length > 1e-6; }
  ShapeGradient places(const FacetNodal<3>& nodes) const {
    return (nodes.rowwise() - origin.transpose()) * axes.transpose();
  }
  Shapes heights(const FacetNodal<3>& nodes) const {
    return (nodes.rowwise() - origin.transpose()) * n;
  }
};

inline FacetNodal<3> counterclockwise(const FacetNodal<3>& master) {
  FacetNodal<3> result;
  for (int b = 0; b < 4; ++b) result.row(b) = master.row(reversed[b]);
  return result;
}

/// The second derivative of a facet's points by its parent coordinates.
inline Vector<3> twist_of(const FacetNodal<3>& nodes) {
  return (nodes.row(0) - nodes.row(1) + nodes.row(2) - nodes.row(3)) / 4;
}

/// Whether the spheres around the nodes exclude that the facets meet.
inline bool apart(const FacetPair<3>& pair, double reach) {
  const auto radius = [](const FacetNodal<3>& nodes, const Vector<3>& centre) {
    return std::sqrt((nodes.rowwise() - centre.transpose()).rowwise().squaredNorm().maxCoeff());
  };
  const Vector<3> slave = pair.x.colwise().mean(), master = pair.y.colwise().mean(),
                  n = pair.n.colwise().sum().transpose().normalized();
  const double both = radius(pair.x, slave) + radius(pair.y, master);
  const Vector<3> between = master - slave;
  const double along = between.dot(n);
  return std::abs(along) > both + reach || (between - along * n).norm() > both;
}

/// The undeformed area of the slave per area in the plane.
struct AreaRatio {
  Vector<3> g1, g2,
      area;  ///< tangents of the undeformed slave by parent coordinates, their product
  double undeformed, J, value;

  AreaRatio(const FacetNodal<3>& X, const Quadrilateral& slave, const Point& xi)
      : AreaRatio(X, slave.jacobian(xi), shape_gradient(xi)) {}

private:
  AreaRatio(const FacetNodal<3>& X, double jacobian, const ShapeGradient& by_xi)
      : g1(X.transpose() * by_xi.col(0)),
        g2(X.transpose() * by_xi.col(1)),
        area(g1.cross(g2)),
        undeformed(area.norm()),
        J(jacobian),
        value(undeformed / J) {}
};

struct AreaRatioGradient {
  Point by_xi;
  ByNodes by_X;
  ShapeGradient by_slave;

  AreaRatioGradient(const AreaRatio& ratio, const FacetNodal<3>& X, const Quadrilateral& slave,
                    const Point& xi) {
    const ShapeGradient gradient = shape_gradient(xi);
    const Vector<3> N = ratio.area / (std::max(ratio.undeformed, 1e-300) * ratio.J),
                    by_g1 = ratio.g2.cross(N), by_g2 = N.cross(ratio.g1), twist = twist_of(X);
    by_xi = Point(twist.dot(by_g2), twist.dot(by_g1)) - ratio.value / ratio.J * slave.slope();
    by_X = gradient.col(0) * by_g1.transpose() + gradient.col(1) * by_g2.transpose();
    by_slave = -ratio.value / ratio.J * slave.jacobian_by_nodes(xi);
  }
};

/// The two facets in the plane.
class PairInPlane {
public:
  PairInPlane(const FacetPair<3>& given, double reach)
      : pair(given),
        frame(given),
        slave(frame.places(given.x)),
        master(frame.places(counterclockwise(given.y))),
        slave_height(frame.heights(given.x)),
        master_height(frame.heights(counterclockwise(given.y))),
        overlap(meet() ? Overlap(slave, master) : Overlap()) {
    is_empty_ = overlap.corners() < 3 || !(overlap.area() > 0) || distance() > reach;
  }
  PairInPlane(const PairInPlane&) = delete;
  bool is_empty() const { return is_empty_; }
  bool parallelograms() const { return slave.parallelogram() && master.parallelogram(); }
  /// What keeps the integrands from being polynomials in the plane; 0: nothing.
  double irregularity() const {
    const Vector<3> twist = twist_of(pair.X),
                    area = (pair.X.row(2) - pair.X.row(0)).cross(pair.X.row(3) - pair.X.row(1)) / 8;
    const double warp = std::abs(twist.dot(area)) / std::max(std::pow(area.norm(), 1.5), 1e-300),
                 turn = (pair.n.rowwise() - frame.n.transpose()).cwiseAbs().maxCoeff();
    return std::max({slave.distortion(), master.distortion(), warp, turn});
  }

  const FacetPair<3>& pair;
  Frame frame;
  Quadrilateral slave, master;
  Shapes slave_height, master_height;
  Overlap overlap;

private:
  /// A facet that is seen nearly from its edge does not face the other.
  static bool faces(const Quadrilateral& projected, const FacetNodal<3>& nodes) {
    const Vector<3> diagonal = nodes.row(2) - nodes.row(0), other = nodes.row(3) - nodes.row(1);
    return projected.middle() > 0.01 * diagonal.cross(other).norm() / 8 && projected.convex();
  }
  bool meet() const { return frame.is_valid() && faces(slave, pair.x) && faces(master, pair.y); }
  double distance() const {
    const Point p = overlap.mean();
    return std::abs(shapes(master.parent(p)).dot(master_height) -
                    shapes(slave.parent(p)).dot(slave_height));
  }
  bool is_empty_;
};

/// The integrands per area in the plane, at one point.
struct Integrand {
  Point xi, eta;
  Shapes phi, N;
  AreaRatio ratio;
  double height, gap;  ///< of the master above the slave, along n_0; and times n_0 . n
  Vector<3> mean, n;   ///< of the nodal normals, and normalised
  Sums value;

  Integrand(const PairInPlane& at, const Point& p)
      : xi(at.slave.parent(p)),
        eta(at.master.parent(p)),
        phi(shapes(xi)),
        N(shapes(eta)),
        ratio(at.pair.X, at.slave, xi),
        height(N.dot(at.master_height) - phi.dot(at.slave_height)),
        mean(at.pair.n.transpose() * phi),
        n(mean / mean.norm()) {
    gap = height * at.frame.n.dot(n);
    const Shapes weighted = ratio.value * phi;
    value << squares(weighted, phi), products(weighted, N), weighted * gap, phi, N;
  }
  /// Of all nodes of the slave with all of the master, column by column.
  static Eigen::Matrix<double, 16, 1> products(const Shapes& first, const Shapes& second) {
    return (first * second.transpose()).reshaped();
  }
  /// Of the pairs of nodes of the slave.
  static Eigen::Matrix<double, 10, 1> squares(const Shapes& first, const Shapes& second) {
    Eigen::Matrix<double, 10, 1> result;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b <= a; ++b) result[mass_row(a, b)] = first[a] * second[b];
    return result;
  }
};

/// The derivatives of an Integrand by parent coordinates, at constant nodes.
struct IntegrandGradient {
  AreaRatioGradient ratio;
  SumsGradient by_xi, by_eta;
  Vector<3> cosine_by_mean;  ///< of n_0 . n, by the mean of the nodal normals

  IntegrandGradient(const PairInPlane& at, const Integrand& here)
      : ratio(here.ratio, at.pair.X, at.slave, here.xi) {
    const ShapeGradient phi_by = shape_gradient(here.xi), N_by = shape_gradient(here.eta);
    const Vector<3>& n_0 = at.frame.n;
    const double cosine = n_0.dot(here.n);
    cosine_by_mean = (n_0 - cosine * here.n) / here.mean.norm();
    const Shapes weighted = here.ratio.value * here.phi;
    const Point gap_by_eta = cosine * N_by.transpose() * at.master_height,
                gap_by_xi = phi_by.transpose() *
                            (here.height * (at.pair.n * cosine_by_mean) - cosine * at.slave_height);
    for (int i = 0; i < 2; ++i) {
      const Shapes change = here.ratio.value * phi_by.col(i) + ratio.by_xi[i] * here.phi;
      by_xi.col(i) << Integrand::squares(change, here.phi) +
                          Integrand::squares(weighted, phi_by.col(i)),
          Integrand::products(change, here.N), change * here.gap + weighted * gap_by_xi[i],
          phi_by.col(i), Shapes::Zero();
      by_eta.col(i) << Eigen::Matrix<double, 10, 1>::Zero(),
          Integrand::products(weighted, N_by.col(i)), weighted * gap_by_eta[i], Shapes::Zero(),
          N_by.col(i);
    }
  }
};

}  // namespace gnomon::mortar
