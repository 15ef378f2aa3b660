// The mortar integrals of facets in space (mortar_kernel.hpp).
//
// Both facets are seen along n_0, the mean of the slave's nodal normals, in a plane across it.
// There they are bilinear quadrilaterals of the projected nodes, and their overlap is a convex
// polygon: this does not depend on how the facets are warped, and facets with a common edge neither
// overlap nor leave a gap. x^2 is the point of the master at the same place in the plane. Triangles
// of the polygon are integrated by a rule for polynomials. That is exact if both facets are
// parallelograms; otherwise the first moments, int phi_a dS and int N_b dS, are corrected by those
// of ShapeIntegrals: sums over facets are exact then on flat surfaces, and so is the patch test.
#include <algorithm>
#include <array>
#include <gnomon/terms/mortar_kernel.hpp>
#include <span>
#include <type_traits>

#include "terms/mortar_integrand.hpp"
#include "terms/mortar_overlap.hpp"
#include "terms/triangle_rule.hpp"

namespace gnomon {

namespace {

using namespace mortar;

/// The derivatives of the sums by the quantities in the plane.
struct InPlane {
  std::array<SumsGradient, Overlap::most_corners> by_corner;
  SumsByNodes by_slave = SumsByNodes::Zero(), by_master = SumsByNodes::Zero();
  Eigen::Matrix<double, values, 12> by_X = Eigen::Matrix<double, values, 12>::Zero();
  // Only of the gap:
  Eigen::Matrix4d by_slave_height = Eigen::Matrix4d::Zero(),
                  by_master_height = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 12> by_n = Eigen::Matrix<double, 4, 12>::Zero();
  ShapeGradient by_turn = ShapeGradient::Zero();  ///< of n_0, at constant places and heights

  explicit InPlane(int corners) {
    for (int k = 0; k < corners; ++k) by_corner[k].setZero();
  }
};

using Triangle = std::array<int, 3>;  ///< corners of the overlap

/// The integrals, and their derivatives where they are wanted.
template <bool derivatives>
class Integrals {
public:
  explicit Integrals(const PairInPlane& at) : at_(at), in_plane(at.overlap.corners()) {
    const std::span<const TrianglePoint> rule = triangle_rule(at.irregularity());
    for (int k = 2; k < at.overlap.corners(); ++k)
      for (const TrianglePoint& point : rule) add({0, k - 1, k}, point);
    if (!at.parallelograms()) correct();
  }

private:
  struct Nothing {
    explicit Nothing(int) {}
  };

  void add(const Triangle& triangle, const TrianglePoint& point);
  void add_derivatives(const Integrand& here, const Triangle& triangle, const TrianglePoint& point,
                       double area);
  void correct();
  void correct_derivatives(const ShapeIntegrals& slave, const ShapeIntegrals& master,
                           const AreaRatio& ratio, const Eigen::Matrix<double, values, 8>& part);

  const PairInPlane& at_;

public:
  Sums value = Sums::Zero();
  std::conditional_t<derivatives, InPlane, Nothing> in_plane;
};

template <bool derivatives>
void Integrals<derivatives>::add(const Triangle& triangle, const TrianglePoint& point) {
  Point p = Point::Zero();
  for (int k = 0; k < 3; ++k) p += point.at[k] * at_.overlap.corner(triangle[k]);
  const Point& first = at_.overlap.corner(triangle[0]);
  const double area =
      cross(at_.overlap.corner(triangle[1]) - first, at_.overlap.corner(triangle[2]) - first) / 2;
  const Integrand here(at_, p);
  value += point.weight * area * here.value;
  if constexpr (derivatives) add_derivatives(here, triangle, point, area);
}

template <bool derivatives>
void Integrals<derivatives>::add_derivatives(const Integrand& here, const Triangle& triangle,
                                             const TrianglePoint& point, double area) {
  const double weight = point.weight * area;
  const IntegrandGradient gradient(at_, here);
  const Eigen::Matrix2d xi_by = weight * at_.slave.parent_by_point(here.xi),
                        eta_by = weight * at_.master.parent_by_point(here.eta);
  const SumsGradient by_slave = gradient.by_xi.lazyProduct(xi_by),
                     by_master = gradient.by_eta.lazyProduct(eta_by),
                     by_point = by_slave + by_master;
  for (int k = 0; k < 3; ++k) {
    const Point opposite =
        at_.overlap.corner(triangle[(k + 2) % 3]) - at_.overlap.corner(triangle[(k + 1) % 3]);
    in_plane.by_corner[triangle[k]] +=
        point.at[k] * by_point + here.value * (point.weight / 2 * left(opposite)).transpose();
  }
  const Eigen::Matrix<double, values, 1> per_ratio =
      weight / std::max(here.ratio.value, 1e-300) * here.value.template head<values>();
  for (int a = 0; a < 4; ++a) {
    auto slave = in_plane.by_slave.template middleCols<2>(2 * a);
    slave -= here.phi[a] * by_slave;
    slave.template topRows<values>() += per_ratio * gradient.ratio.by_slave.row(a);
    in_plane.by_master.template middleCols<2>(2 * a) -= here.N[a] * by_master;
    in_plane.by_X.template middleCols<3>(3 * a) += per_ratio * gradient.ratio.by_X.row(a);
  }
  const Shapes by_gap = weight * here.ratio.value * here.phi,
               by_height = at_.frame.n.dot(here.n) * by_gap, by_cosine = here.height * by_gap;
  in_plane.by_slave_height -= by_height * here.phi.transpose();
  in_plane.by_master_height += by_height * here.N.transpose();
  in_plane.by_turn += by_cosine * (at_.frame.axes * here.n).transpose();
  for (int a = 0; a < 4; ++a)
    in_plane.by_n.template middleCols<3>(3 * a) +=
        by_cosine * (here.phi[a] * gradient.cosine_by_mean).transpose();
}

/// With the errors r_a of int phi_a dS and s_b of int N_b dS, whose sums are zero, (r_a + r_b)/4
/// for the mass and (r_a + s_b)/4 for the coupling correct the sums over either node; what this
/// changes at the heights of the nodes is the correction of the gap.
template <bool derivatives>
void Integrals<derivatives>::correct() {
  const ShapeIntegrals slave(at_.slave, at_.overlap, derivatives),
      master(at_.master, at_.overlap, derivatives);
  const AreaRatio ratio(at_.pair.X, at_.slave, Point::Zero());
  Eigen::Matrix<double, values, 8> part = Eigen::Matrix<double, values, 8>::Zero();
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const double h = at_.slave_height[b] / 4, k = at_.master_height[b] / 4;
      part(mass_row(a, b), a) = part(mass_row(a, b), b) = a == b ? 0.5 : 0.25;
      part(coupling_row(a, b), a) = part(coupling_row(a, b), 4 + b) = 0.25;
      part(gap_0 + a, a) += k - h;
      part(gap_0 + a, b) -= h;
      part(gap_0 + a, 4 + b) += k;
    }
  if constexpr (derivatives) correct_derivatives(slave, master, ratio, part);
  auto moments = value.template tail<8>();
  moments.template head<4>() = slave.value - moments.template head<4>();
  moments.template tail<4>() = master.value - moments.template tail<4>();
  value.template head<values>() += ratio.value * part * moments;
  if constexpr (derivatives) {
    const AreaRatioGradient ratio_gradient(ratio, at_.pair.X, at_.slave, Point::Zero());
    const Eigen::Matrix<double, values, 1> per_ratio = part * moments;
    const Eigen::Matrix<double, 8, 1> error = ratio.value * moments;
    for (int a = 0; a < 4; ++a) {
      in_plane.by_slave.template block<values, 2>(0, 2 * a) +=
          per_ratio * ratio_gradient.by_slave.row(a);
      in_plane.by_X.template middleCols<3>(3 * a) += per_ratio * ratio_gradient.by_X.row(a);
      for (int b = 0; b < 4; ++b) {
        in_plane.by_slave_height(a, b) -= (error[a] + error[b]) / 4;
        in_plane.by_master_height(a, b) += (error[a] + error[4 + b]) / 4;
      }
    }
  }
}

/// What enters through the errors themselves.
template <bool derivatives>
void Integrals<derivatives>::correct_derivatives(const ShapeIntegrals& slave,
                                                 const ShapeIntegrals& master,
                                                 const AreaRatio& ratio,
                                                 const Eigen::Matrix<double, values, 8>& part) {
  const Eigen::Matrix<double, values, 8> scaled = ratio.value * part;
  const auto add = [&](auto&& by, const auto& exact_slave, const auto& exact_master) {
    auto error = (-by.template bottomRows<8>()).eval();
    error.template topRows<4>() += exact_slave;
    error.template bottomRows<4>() += exact_master;
    by.template topRows<values>() += scaled * error;
  };
  const Eigen::Matrix<double, 4, 8> none = Eigen::Matrix<double, 4, 8>::Zero();
  add(in_plane.by_slave, slave.by_nodes, none);
  add(in_plane.by_master, none, master.by_nodes);
  for (Eigen::Index k = 0; k < at_.overlap.corners(); ++k)
    add(in_plane.by_corner[k], slave.by_corners.template middleCols<2>(2 * k),
        master.by_corners.template middleCols<2>(2 * k));
}

constexpr int entries = CoveredPartTangent<3>::values;
/// Of each entry of a CoveredPart, the row of the sums; `shared` is the coupling in 3D.
std::array<int, entries> rows() {
  std::array<int, entries> result;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      result[a + 4 * b] = mass_row(a, b);
      result[16 + a + 4 * b] = result[32 + a + 4 * b] = coupling_row(a, reversed[b]);
    }
    result[48 + a] = gap_0 + a;
  }
  return result;
}

CoveredPart<3> covered(const Sums& value) {
  CoveredPart<3> result;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      result.mass(a, b) = value[mass_row(a, b)];
      result.coupling(a, b) = value[coupling_row(a, reversed[b])];
    }
  result.shared = result.coupling;
  result.gap = value.segment<4>(gap_0);
  return result;
}

/// By the positions of nodes, and by the turn of n_0, from the derivatives by places and heights:
/// d place = axes dx - height dn_0, d height = n_0 . dx + place . dn_0, dn_0 in the plane.
class OutOfPlane {
public:
  using ByInput = Eigen::Matrix<double, values, 48>;

  OutOfPlane(const PairInPlane& at, InPlane& in_plane) : at_(at) {
    for (int k = 0; k < at.overlap.corners(); ++k)
      at.overlap.add_corner(k, in_plane.by_corner[k], in_plane.by_slave, in_plane.by_master);
    by_input_.leftCols<12>() = in_plane.by_X;
    by_turn_.setZero();
    by_turn_.bottomRows<4>() = in_plane.by_turn;
    for (int a = 0; a < 4; ++a) {
      add(12 + 3 * a, in_plane.by_slave, in_plane.by_slave_height, a, at.slave.node(a),
          at.slave_height[a]);
      add(36 + 3 * reversed[a], in_plane.by_master, in_plane.by_master_height, a, at.master.node(a),
          at.master_height[a]);
    }
    const Eigen::Matrix<double, values, 3> by_normal = by_turn_ * at.frame.axes / at.frame.length;
    for (int a = 0; a < 4; ++a) by_input_.middleCols<3>(24 + 3 * a) = by_normal;
    by_input_.block<4, 12>(gap_0, 24) += in_plane.by_n;
  }
  const ByInput& by_input() const { return by_input_; }

private:
  void add(int column, const SumsByNodes& by_nodes, const Eigen::Matrix4d& by_height,
           Eigen::Index a, const Point& place, double height) {
    const Eigen::Matrix<double, values, 2> by_place = by_nodes.block<values, 2>(0, 2 * a);
    auto by_position = by_input_.middleCols<3>(column);
    by_position = by_place * at_.frame.axes;
    by_position.bottomRows<4>() += by_height.col(a) * at_.frame.n.transpose();
    by_turn_ -= height * by_place;
    by_turn_.bottomRows<4>() += by_height.col(a) * place.transpose();
  }

  const PairInPlane& at_;
  ByInput by_input_;
  Eigen::Matrix<double, values, 2> by_turn_;
};

}  // namespace

CoveredPart<3> covered_part(const FacetPair<3>& pair, Section, double reach) {
  if (apart(pair, reach)) return {};
  const PairInPlane at(pair, reach);
  return at.is_empty() ? CoveredPart<3>{} : covered(Integrals<false>(at).value);
}

CoveredPartTangent<3> covered_part_tangent(const FacetPair<3>& pair, Section, double reach) {
  CoveredPartTangent<3> result;
  if (apart(pair, reach)) return result;
  const PairInPlane at(pair, reach);
  if (at.is_empty()) return result;
  Integrals<true> integrals(at);
  result.part = covered(integrals.value);
  const OutOfPlane out(at, integrals.in_plane);
  const std::array<int, entries> row = rows();
  for (int i = 0; i < entries; ++i) result.by_input.row(i) = out.by_input().row(row[i]);
  return result;
}

}  // namespace gnomon
