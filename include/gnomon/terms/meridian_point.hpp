// Kinematics of a cell of a body of revolution, in coordinates (r, z) with displacements (u_r,
// u_z). The deformation gradient is that of space without its shear to the circumference:
//
//   F = [I + u n^T | 1 + u_r/R],   R = sum N_a X_a,r > 0 at Gauss points.
//
// A displacement v of node a changes it by E_a(v) = [v (x) n_a | v_r m_a], m_a = N_a/R, and what
// moves the configuration X follows the rule of all bodies,
//
//   dF = E_b(du_b) - H E_b(dd_b),   dE_a = -E_a E_b(dd_b),   dw = w tr E_b(dd_b).
#pragma once

#include <array>
#include <cmath>
#include <gnomon/laws/elastic_law.hpp>
#include <gnomon/mesh/cell_basis.hpp>

namespace gnomon {

/// One Gauss point.
template <class Scalar = double>
struct MeridianPoint {
  using T = Tensor<3, Scalar>;
  using PerNode = Eigen::Matrix<Scalar, 4, 1>;

  Scalar volume;           ///< w = 2 pi R det(dX/dxi)
  CellNodal<2, Scalar> n;  ///< rows n_a
  PerNode m;               ///< m_a
  T H = T::Zero(), F;      ///< displacement gradient, deformation gradient
  Scalar J;                ///< det F

  MeridianPoint(int gauss, const CellNodal<2, Scalar>& X, const CellNodal<2, Scalar>& u) {
    const auto& basis = CellBasis<2>::instance();
    const CellNodal<2, Scalar> dN = basis.gauss[gauss].template cast<Scalar>();
    const PerNode N = basis.gauss_values[gauss].template cast<Scalar>();
    const Tensor<2, Scalar> A = X.transpose() * dN;
    const Scalar R = N.dot(X.col(0));
    volume = Scalar(2 * M_PI) * R * A.determinant();
    n = dN * A.inverse();
    m = N / R;
    H.template topLeftCorner<2, 2>() = u.transpose() * n;
    H(2, 2) = m.dot(u.col(0));
    F = T::Identity() + H;
    J = in_plane(F).determinant() * F(2, 2);
  }

  static Tensor<2, Scalar> in_plane(const T& A) { return A.template topLeftCorner<2, 2>(); }

  /// Whether the cell is not inverted here.
  bool valid(Kinematics kinematics) const {
    return volume > Scalar(0) &&
           (kinematics == Kinematics::small || (F(2, 2) > Scalar(0) && J > Scalar(0)));
  }

  /// Rows R_a with R_a . v = P : E_a(v).
  CellNodal<2, Scalar> work(const T& P) const {
    CellNodal<2, Scalar> result = n * in_plane(P).transpose();
    result.col(0) += P(2, 2) * m;
    return result;
  }
  /// F^-1, or 1 with small strains.
  T inverse(Kinematics kinematics) const {
    T result = T::Identity();
    if (kinematics == Kinematics::small) return result;
    result.template topLeftCorner<2, 2>() = in_plane(F).inverse();
    result(2, 2) = Scalar(1) / F(2, 2);
    return result;
  }
  /// The variation of log J (of tr H with small strains) by u: rows g_a.
  CellNodal<2, Scalar> volume_gradient(Kinematics kinematics) const {
    return work(inverse(kinematics).transpose());
  }
};

/// The points of a cell.
template <class Scalar = double>
class MeridianCell {
public:
  MeridianCell(const CellNodal<2, Scalar>& X, const CellNodal<2, Scalar>& u)
      : points_{{{0, X, u}, {1, X, u}, {2, X, u}, {3, X, u}}} {}

  const std::array<MeridianPoint<Scalar>, 4>& points() const { return points_; }
  bool valid(Kinematics kinematics) const {
    for (const MeridianPoint<Scalar>& point : points_)
      if (!point.valid(kinematics)) return false;
    return true;
  }

private:
  std::array<MeridianPoint<Scalar>, 4> points_;
};

/// The mean change of volume of a cell. With finite strains J_0 is the ratio of its volumes,
/// current by undeformed, which the Gauss points give exactly; with small strains tr H_0 is the
/// mean of tr H. In the plane this is the value at the centroid of F-bar elements; in a body of
/// revolution the centroid is not the mean, not even in a rectangle.
template <class Scalar = double>
struct MeridianMean {
  Scalar J = Scalar(1), trace_0 = Scalar(0);  ///< J_0, tr H_0
  CellNodal<2, Scalar> g;                     ///< variation of log J_0 or tr H_0 by u

  MeridianMean(const MeridianCell<Scalar>& cell, Kinematics kinematics) {
    Scalar before(0), after(0), trace(0);
    g.setZero();
    for (const MeridianPoint<Scalar>& point : cell.points()) {
      const Scalar w = weight(point, kinematics);
      before += point.volume;
      after += w;
      trace += point.volume * point.H.trace();
      g += w * point.volume_gradient(kinematics);
    }
    g /= after;
    if (kinematics == Kinematics::finite)
      J = after / before;
    else
      trace_0 = trace / before;
  }

  Scalar trace() const { return trace_0; }
  /// Current volume, or undeformed with small strains.
  static Scalar weight(const MeridianPoint<Scalar>& point, Kinematics kinematics) {
    return kinematics == Kinematics::small ? point.volume : Scalar(point.volume * point.J);
  }
};

}  // namespace gnomon
