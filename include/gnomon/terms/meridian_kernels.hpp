// The kernels of elastic cells of bodies of revolution. With the kinematics of meridian_point.hpp,
// and r = J_0/J, J_0 the mean of the cell, c = r^(1/3), Fbar = c F (F_33 as well),
// Hbar = H + (tr H_0 - tr H)/3 I, the forces are those of solid_kernels.hpp in space:
//
//   R_a . v = sum_g m [P : E_a(v) + q (g0_a - g_a) . v],   g_a . v = tr(F^-1 E_a(v)),  g0_a the
//   mean
//
//   plain              P(F),           m = w,          q = 0
//   f_bar              P(Fbar),        m = w c / r,    q = 0
//   f_bar_variational  P(Fbar),        m = w c,        q = P : F / 3
//   small strains      sigma(H|Hbar),  m = w,          q = 0, or tr sigma / 3; F^-1 = 1 in g_a
//
// The tangent is the variation of these lines, one column per unknown; a law gives its stress
// changes for the five components of F.
#pragma once

#include <gnomon/terms/law_in_cell.hpp>
#include <gnomon/terms/meridian_point.hpp>

namespace gnomon {

/// q of a law at a point.
template <class At, class Scalar>
Scalar pressure_change(const Tensor<3, Scalar>& P, const MeridianPoint<Scalar>& point) {
  return (At::small ? P.trace() : P.cwiseProduct(point.F).sum()) / Scalar(3);
}

/// solid_residual of a body of revolution.
template <ElementTechnology technology, template <int, class> class Law, class Scalar>
bool meridian_residual(const ElasticModuli& moduli, const CellNodal<2, Scalar>& X,
                       const CellNodal<2, Scalar>& u, CellNodal<2, Scalar>& R) {
  using At = LawInCell<technology, Law, 3, Scalar>;
  const MeridianCell<Scalar> cell(X, u);
  if (!cell.valid(At::kinematics)) return false;
  const MeridianMean<Scalar> mean(cell, At::kinematics);
  R.setZero();
  for (const MeridianPoint<Scalar>& point : cell.points()) {
    const At at(moduli, mean, point);
    const Tensor<3, Scalar> P = at.law.stress();
    R += at.weight * point.work(P);
    if constexpr (variational(technology))
      R += Scalar(at.weight * pressure_change<At>(P, point)) *
           (mean.g - point.volume_gradient(At::kinematics));
  }
  return true;
}

/// Matrices of the tangent: components 11, 21, 12, 22, 33 of a tensor; unknown 2 node + component.
namespace meridian {

using Five = Eigen::Matrix<double, 5, 1>;
using Row = Eigen::Matrix<double, 1, 8>;
using Changes = Eigen::Matrix<double, 5, 8>;  ///< of a tensor, by all unknowns

inline Five components(const Tensor<3>& A) {
  return {A(0, 0), A(1, 0), A(0, 1), A(1, 1), A(2, 2)};
}
inline Row row(const CellNodal<2>& nodal) {
  Row result;
  for (int a = 0; a < 4; ++a) result.segment<2>(2 * a) = nodal.row(a);
  return result;
}
/// A E_b for all unknowns.
inline Changes product(const Tensor<3>& A, const MeridianPoint<>& point) {
  Changes result = Changes::Zero();
  for (int b = 0; b < 4; ++b) {
    for (int J = 0; J < 2; ++J)
      result.block<2, 2>(2 * J, 2 * b) = point.n(b, J) * A.topLeftCorner<2, 2>();
    result(4, 2 * b) = A(2, 2) * point.m[b];
  }
  return result;
}
/// P : (E_a(e_i) A E_b(e_j) B) with A and B of the same form: rows (a, i), columns (b, j).
inline CellMatrix<2> crossed(const MeridianPoint<>& point, const Tensor<3>& P, const Tensor<3>& A,
                             const Tensor<3>& B) {
  const CellNodal<2> first = point.n * A.topLeftCorner<2, 2>(),
                     second = point.n * (P * B.transpose()).topLeftCorner<2, 2>().transpose();
  const double hoop = P(2, 2) * A(2, 2) * B(2, 2);
  CellMatrix<2> result;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) result(2 * a + i, 2 * b + j) = first(a, j) * second(b, i);
      result(2 * a, 2 * b) += hoop * point.m[a] * point.m[b];
    }
  return result;
}

}  // namespace meridian

/// The first and second variations of a change of volume: of log J at a point or log J_0 of the
/// cell, with small strains of tr H; those that the technology needs.
template <ElementTechnology technology>
struct VolumeChange {
  meridian::Row by_u = meridian::Row::Zero(), by_d = meridian::Row::Zero();
  CellMatrix<2> second;  ///< of by_u, by d; by u as well with finite strains

  VolumeChange(const MeridianPoint<>& point, Kinematics kinematics) {
    if constexpr (!averaged(technology)) return;
    const Tensor<3> inverse = point.inverse(kinematics), one = Tensor<3>::Identity();
    by_u = meridian::row(point.work(inverse.transpose()));
    by_d = -meridian::row(point.work((inverse * point.H).transpose()));
    if constexpr (variational(technology))
      second = -meridian::crossed(point, one, inverse, inverse);
  }
  /// The mean.
  VolumeChange(const MeridianCell<>& cell, Kinematics kinematics) {
    if constexpr (!averaged(technology)) return;
    const bool small = kinematics == Kinematics::small;
    double before = 0, after = 0, trace = 0;
    meridian::Row reference = meridian::Row::Zero();  // of the undeformed volume, by d
    second.setZero();
    for (const MeridianPoint<>& point : cell.points()) {
      const VolumeChange here(point, kinematics);
      const double w = MeridianMean<>::weight(point, kinematics);
      const meridian::Row n = meridian::row(point.work(Tensor<3>::Identity()));
      before += point.volume, after += w;
      trace += point.volume * point.H.trace();
      reference += point.volume * n;
      by_u += w * here.by_u;
      if (small) by_d += w * (here.by_d + point.H.trace() * n);
      if constexpr (variational(technology))
        second += w * (here.by_u.transpose() * here.by_u + here.second);
    }
    by_u /= after;
    if constexpr (variational(technology)) second = second / after - by_u.transpose() * by_u;
    reference /= before;
    by_d = small ? meridian::Row(by_d / before - trace / before * reference)
                 : meridian::Row(by_u - reference);
  }
};

/// Tangent of a cell.
template <ElementTechnology technology, template <int, class> class Law>
class MeridianTangent {
public:
  using At = LawInCell<technology, Law, 3>;
  using Row = meridian::Row;

  MeridianTangent(const ElasticModuli& moduli, const MeridianCell<>& cell)
      : moduli_(moduli), mean_(cell, At::kinematics), change_0_(cell, At::kinematics) {}

  /// Adds a point to R, K_u and, if it is not null, K_d.
  void add(const MeridianPoint<>& point, CellNodal<2>& R, CellMatrix<2>& K_u,
           CellMatrix<2>* K_d) const {
    constexpr bool small = At::small;
    const Tensor<3> one = Tensor<3>::Identity();
    const At at(moduli_, mean_, point);
    const VolumeChange<technology> change(point, At::kinematics);
    const Tensor<3> P = at.law.stress();
    Eigen::Matrix<double, 5, 5> D;
    for (int k = 0; k < 5; ++k) {
      Tensor<3> unit = Tensor<3>::Zero();
      (k == 4 ? unit(2, 2) : unit(k % 2, k / 2)) = 1;
      D.col(k) = meridian::components(at.law.stress_change(unit));
    }
    const double q = variational(technology) ? pressure_change<At>(P, point) : 0;
    const meridian::Changes B = meridian::product(one, point);
    const meridian::Five P5 = meridian::components(P),
                         Z = D * meridian::components(small ? one : at.strain),
                         weighted = meridian::components(small ? one : point.F);
    const Row e = change_0_.by_u - change.by_u;
    const Row S = P5.transpose() * B + q * e;

    const auto tangent = [&](const Variation& by) {
      const Row stretch = by.volume / 3;
      meridian::Changes dP = at.c * D * by.strain;
      Row weight = by.weight;
      if constexpr (averaged(technology)) {
        dP += Z * stretch;
        if constexpr (!small) weight += (variational(technology) ? 1 : -2) * stretch;
      }
      CellMatrix<2> K = B.transpose().lazyProduct(dP);  // small: faster than blocks
      K += S.transpose() * weight;
      if constexpr (variational(technology)) {
        Row dq = weighted.transpose() * dP / 3;
        if constexpr (!small) dq += P5.transpose() * by.strain / 3;
        K += e.transpose() * dq;
        if (by.gradients) K += q * (change_0_.second - change.second);
      }
      return K;
    };
    for (int a = 0; a < 4; ++a) R.row(a) += at.weight * S.segment<2>(2 * a);
    K_u += at.weight * tangent({B, change_0_.by_u - change.by_u, Row::Zero(), !small});
    if (!K_d) return;
    const Row by_volume = meridian::row(point.work(one));
    *K_d += at.weight * (tangent({-meridian::product(point.H, point), change_0_.by_d - change.by_d,
                                  by_volume, true}) -
                         meridian::crossed(point, P, one, one));
  }

private:
  /// A variation of the point, by all unknowns.
  struct Variation {
    meridian::Changes strain;  ///< of F or H
    Row volume;                ///< of log J_0/J or tr H_0 - tr H
    Row weight;                ///< of log w
    bool gradients;            ///< whether g0_a - g_a change
  };

  const ElasticModuli& moduli_;
  MeridianMean<> mean_;
  VolumeChange<technology> change_0_;
};

/// solid_tangent of a body of revolution.
template <ElementTechnology technology, template <int, class> class Law, bool with_shape>
bool meridian_tangent(const ElasticModuli& moduli, const CellNodal<2>& X, const CellNodal<2>& u,
                      CellNodal<2>& R, CellMatrix<2>& K_u, CellMatrix<2>& K_d) {
  const MeridianCell<> cell(X, u);
  if (!cell.valid(Law<3, double>::kinematics)) return false;
  const MeridianTangent<technology, Law> tangent(moduli, cell);
  R.setZero(), K_u.setZero();
  if (with_shape) K_d.setZero();
  for (const MeridianPoint<>& point : cell.points())
    tangent.add(point, R, K_u, with_shape ? &K_d : nullptr);
  return true;
}

/// CellKernel::equivalent_stress of a body of revolution.
template <ElementTechnology technology, template <int, class> class Law>
double meridian_equivalent_stress(const ElasticModuli& moduli, const CellNodal<2>& X,
                                  const CellNodal<2>& u) {
  using At = LawInCell<technology, Law, 3>;
  const MeridianCell<> cell(X, u);
  const MeridianMean<> mean(cell, At::kinematics);
  double sum = 0;
  for (const MeridianPoint<>& point : cell.points()) {
    sum += von_mises_stress<Law, 3>(moduli, At(moduli, mean, point).strain);
  }
  return sum / 4;
}

template <ElementTechnology technology, template <int, class> class Law>
inline constexpr CellKernel<2> meridian_kernel = {
    &meridian_residual<technology, Law, double>, &meridian_tangent<technology, Law, false>,
    &meridian_tangent<technology, Law, true>, &meridian_equivalent_stress<technology, Law>};

template <template <int, class> class Law>
inline constexpr CellKernels<2> meridian_kernels = {
    meridian_kernel<ElementTechnology::plain, Law>, meridian_kernel<ElementTechnology::f_bar, Law>,
    meridian_kernel<ElementTechnology::f_bar_variational, Law>};

}  // namespace gnomon
