// The kernels of elastic cells, for files that register a law (material_law.hpp) or differentiate
// one. With
//
//   H = (du/dxi)(dX/dxi)^-1,   F = I + H,   n_a = (dX/dxi)^-T dN_a/dxi,
//   g_a = F^-T n_a (gradient in the current configuration), index 0: at the centroid,
//   r = J_0 / J,   Fbar = r^(1/dim) F,
//
// and P the stress of the law, the forces of finite strains are
//
//   plain              R_a = sum_g det(dX/dxi) P(F) n_a
//   f_bar              R_a = sum_g det(dX/dxi) r^(1/dim - 1) P(Fbar) n_a
//                      (= sum_g w sigma(Fbar) g_a; E. A. de Souza Neto et al., Int. J. Solids
//                      Struct. 33 (1996) 3277, in 2D the in-plane form)
//   f_bar_variational  R_a = sum_g det(dX/dxi) d phi(Fbar)/du_a, as eq. (32) is written:
//                      r^(1/dim) [P(Fbar) n_a + q (g0_a - g_a)],  q = P(Fbar) : F / dim
//
// With small strains they are these linearized in u at u = 0, over the same X: with
// Hbar = H + (tr H_0 - tr H)/dim I, sigma linear elastic, g_a = n_a,
//
//   plain              R_a = sum_g det(dX/dxi) sigma(H) n_a
//   f_bar              R_a = sum_g det(dX/dxi) sigma(Hbar) n_a
//   f_bar_variational  R_a = sum_g det(dX/dxi) [sigma(Hbar) n_a + q (n0_a - n_a)],
//                      q = tr sigma(Hbar) / dim
//
// Variations, with v = du - H dd (times n_b: the variation of H) and v0 the same at the centroid:
//   dr/r = g0_b . v0 - g_b . v,   dn_a = -n_b (n_a . dd_b),   dg_a = -g_b (g_a . (du_b + dd_b)).
#pragma once

#include <gnomon/terms/dyad_sums.hpp>
#include <gnomon/terms/law_in_cell.hpp>
#include <gnomon/terms/meridian_kernels.hpp>

namespace gnomon {

/// R [dim x nodes, one row per node] of a cell; false when the cell is inverted. The undeformed
/// configuration X = X^ + d [length], displacement u [length].
template <ElementTechnology technology, template <int, class> class Law, int dim, class Scalar>
bool solid_residual(const ElasticModuli& moduli, const CellNodal<dim, Scalar>& X,
                    const CellNodal<dim, Scalar>& u, CellNodal<dim, Scalar>& R) {
  using At = LawInCell<technology, Law, dim, Scalar>;
  constexpr Kinematics kinematics = At::kinematics;
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim, Scalar> centre(basis.centroid, X, u);
  if (!centre.valid(kinematics)) return false;
  R.setZero();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim, Scalar> point(dN, X, u);
    if (!point.valid(kinematics)) return false;
    const At at(moduli, centre, point);
    const Tensor<dim, Scalar> P = at.law.stress();
    R += at.weight * point.n * P.transpose();
    if constexpr (variational(technology) && !At::small)
      R += Scalar(at.weight * P.cwiseProduct(point.F).sum() / Scalar(dim)) *
           (centre.spatial_gradients() - point.spatial_gradients());
    if constexpr (variational(technology) && At::small)
      R += Scalar(at.weight * P.trace() / Scalar(dim)) * (centre.n - point.n);
  }
  return true;
}

/// Gradients for the variation of a change of volume.
template <int dim>
struct VolumeGradients {
  CellNodal<dim> g;  ///< rows g_a; n_a with small strains
  CellNodal<dim> p;  ///< rows -H^T g_a: g_b . v = g_b . du_b + p_b . dd_b

  VolumeGradients(bool small, const CellPoint<dim>& point)
      : g(small ? point.n : point.spatial_gradients()), p(-g * point.H) {}
};

/// Tangent of a cell: terms of docs/notes/kernels.md, Gauss point by Gauss point; weights are put
/// into the factors.
template <ElementTechnology technology, template <int, class> class Law, bool with_shape, int dim>
class CellTangent {
public:
  using Nodal = CellNodal<dim>;
  using At = LawInCell<technology, Law, dim>;

  CellTangent(const ElasticModuli& moduli, const CellPoint<dim>& centre)
      : moduli_(moduli), centre_(centre), at_centre_(At::small, centre) {}

  void add(const CellPoint<dim>& point, CellNodal<dim>& R) {
    const At at(moduli_, centre_, point);
    const double m = at.weight, c = at.c;
    const VolumeGradients<dim> here(At::small, point);
    const Nodal &n = point.n, &g = here.g, &p = here.p, &g0 = at_centre_.g, &p0 = at_centre_.p;
    const Tensor<dim> P = at.law.stress();
    const Nodal Pn = m * n * P.transpose();
    double crossed = 0;  // factor of g_b (x) g_a in K_u, in addition to the law
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): f_bar changes it
    Nodal S = Pn;
    if constexpr (averaged(technology)) {
      Tensor<dim> B = Tensor<dim>::Identity();  // change of the strain by a change of volume
      if constexpr (!At::small) B = at.strain;
      const Tensor<dim> Z = at.law.stress_change(B);
      const Nodal Zn = m * n * Z.transpose();
      Nodal h = Zn / dim;
      if constexpr (technology == ElementTechnology::f_bar && !At::small) h += (1.0 / dim - 1) * Pn;
      if constexpr (variational(technology)) {
        const double q = m * P.cwiseProduct(B).sum() / (dim * c);
        const Nodal e = g0 - g;
        Nodal dq = Zn / dim;
        S += q * e;
        h += (m * Z.cwiseProduct(B).sum() / (dim * dim * c)) * e;
        if constexpr (!At::small) h += S / dim, dq += Pn / dim;
        by_u_.direct.add(e, dq);
        if constexpr (!At::small) crossed = q, by_u_.crossed.add(g0, -q * g0);
        if constexpr (with_shape) {
          by_d_.direct.add(e, -dq * point.H);
          by_d_.crossed.add(g, q * g);
          by_d_.crossed.add(g0, -q * g0);
        }
      }
      by_u_.direct.add(h, g0 - g);
      if constexpr (with_shape) by_d_.direct.add(h, p0 - p);
    }
    R += S;
    add_law(at, point, here, crossed);
    if constexpr (with_shape) {
      by_d_.direct.add(S, n);
      by_d_.crossed.add(n, -Pn);
    }
  }
  void write(CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) const {
    by_u_.write(K_u);
    if constexpr (with_shape) by_d_.write(K_d);
  }

private:
  static constexpr bool dyadic = DyadicPoint<typename At::Point>;
  static constexpr bool finite_variational = variational(technology) && !At::small;
  static constexpr int direct_dyads = dyadic + averaged(technology) + variational(technology);

  /// Adds the effect of a change of strain at constant reference volume, and `crossed` g_b (x) g_a.
  void add_law(const At& at, const CellPoint<dim>& point, const VolumeGradients<dim>& here,
               double crossed) {
    const double m = at.weight, c = at.c;
    const Nodal &n = point.n, &g = here.g, &p = here.p;
    if constexpr (dyadic) {
      const double volumetric = m * at.law.volumetric() / c, geometric = m * at.law.geometric() / c,
                   shear = m * c * at.law.shear();
      by_u_.direct.add(g, volumetric * g);
      by_u_.crossed.add(g, (geometric + crossed) * g);
      by_u_.law.add(n, shear * Tensor<dim>::Identity());
      if constexpr (with_shape) {
        by_d_.direct.add(g, volumetric * p);
        by_d_.crossed.add(p, geometric * g);
        by_d_.law.add(n, -shear * point.H);
      }
    } else {
      typename StressChangeSum<dim>::Changes by_u, by_d;
      for (int j = 0; j < dim; ++j)
        for (int J = 0; J < dim; ++J) {
          Tensor<dim> dF = Tensor<dim>::Zero();
          dF(j, J) = 1;
          by_u[j][J] = m * c * n * at.law.stress_change(dF).transpose();
        }
      by_u_.law.add(n, by_u);
      if constexpr (finite_variational) by_u_.crossed.add(g, crossed * g);
      if constexpr (with_shape) {  // a shape e_j changes the strain by -H e_j (x) n_b
        for (int j = 0; j < dim; ++j)
          for (int J = 0; J < dim; ++J) {
            by_d[j][J].setZero();
            for (int k = 0; k < dim; ++k) by_d[j][J] -= point.H(k, j) * by_u[k][J];
          }
        by_d_.law.add(n, by_d);
      }
    }
  }

  const ElasticModuli& moduli_;
  const CellPoint<dim>& centre_;
  VolumeGradients<dim> at_centre_;
  TangentSum<dim, direct_dyads, dyadic + finite_variational + (!dyadic && finite_variational),
             dyadic>
      by_u_;
  TangentSum<dim, direct_dyads + 1, 1 + dyadic + 2 * variational(technology), dyadic> by_d_;
};

/// Derivatives of the cell residual: K_u = dR/du, and K_d = dR/dd if `with_shape`. Same return
/// value as solid_residual; R is computed too.
template <ElementTechnology technology, template <int, class> class Law, bool with_shape, int dim>
bool solid_tangent(const ElasticModuli& moduli, const CellNodal<dim>& X, const CellNodal<dim>& u,
                   CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  constexpr Kinematics kinematics = Law<dim, double>::kinematics;
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  if (!centre.valid(kinematics)) return false;
  CellTangent<technology, Law, with_shape, dim> tangent(moduli, centre);
  R.setZero();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim> point(dN, X, u);
    if (!point.valid(kinematics)) return false;
    tangent.add(point, R);
  }
  tangent.write(K_u, K_d);
  return true;
}

/// CellKernel::equivalent_stress.
template <ElementTechnology technology, template <int, class> class Law, int dim>
double solid_equivalent_stress(const ElasticModuli& moduli, const CellNodal<dim>& X,
                               const CellNodal<dim>& u) {
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  double sum = 0;
  for (const CellNodal<dim>& dN : basis.gauss) {
    const LawInCell<technology, Law, dim> at(moduli, centre, CellPoint<dim>(dN, X, u));
    sum += von_mises_stress<Law, dim>(moduli, at.strain);
  }
  return sum / CellBasis<dim>::points;
}

/// The functions of a CellKernel. All calls below them are inlined ("flatten"): with many kernels
/// in a source file the compiler would otherwise stop at its limit of growth, and residuals take up
/// to 1.5 times as long.
template <ElementTechnology technology, template <int, class> class Law, int dim>
struct FlatKernel {
  using Nodal = CellNodal<dim>;

  [[gnu::flatten]] static bool residual(const ElasticModuli& moduli, const Nodal& X, const Nodal& u,
                                        Nodal& R) {
    return solid_residual<technology, Law, dim, double>(moduli, X, u, R);
  }
  template <bool with_shape>
  [[gnu::flatten]] static bool tangent(const ElasticModuli& moduli, const Nodal& X, const Nodal& u,
                                       Nodal& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
    return solid_tangent<technology, Law, with_shape, dim>(moduli, X, u, R, K_u, K_d);
  }
};

template <ElementTechnology technology, template <int, class> class Law, int dim>
inline constexpr CellKernel<dim> cell_kernel = {
    &FlatKernel<technology, Law, dim>::residual,
    &FlatKernel<technology, Law, dim>::template tangent<false>,
    &FlatKernel<technology, Law, dim>::template tangent<true>,
    &solid_equivalent_stress<technology, Law, dim>};

template <template <int, class> class Law, int dim>
inline constexpr CellKernels<dim> cell_kernels = {
    cell_kernel<ElementTechnology::plain, Law, dim>,
    cell_kernel<ElementTechnology::f_bar, Law, dim>,
    cell_kernel<ElementTechnology::f_bar_variational, Law, dim>};

/// All kernels of a law. They are compiled in the file that takes the address.
template <template <int, class> class Law>
inline constexpr LawKernels law_kernels = {cell_kernels<Law, 2>, cell_kernels<Law, 3>,
                                           meridian_kernels<Law>};

}  // namespace gnomon
