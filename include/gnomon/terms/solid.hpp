// A hyperelastic cell whose reference configuration moves: residual of eq. (24), integrated over
// the undeformed configuration X = X^ + d, and its derivatives with respect to u and to d.
//
//   F = I + (du/dxi)(dX/dxi)^-1 = (dx/dxi)(dX/dxi)^-1,     n_a = (dX/dxi)^-T dN_a/dxi,
//   g_a = F^-T n_a (gradient in the current configuration), index 0: at the centroid,
//   r = J_0 / J,   Fbar = r^(1/dim) F.
//
//   plain              R_a = sum_g det(dX/dxi) P(F) n_a
//   f_bar              R_a = sum_g det(dX/dxi) r^(1/dim - 1) P(Fbar) n_a   (= sum_g w sigma(Fbar)
//   g_a;
//                      E. A. de Souza Neto et al., Int. J. Solids Struct. 33 (1996) 3277, in 2D the
//                      in-plane form)
//   f_bar_variational  R_a = sum_g det(dX/dxi) d phi(Fbar)/du_a, the literal reading of eq. (32):
//                      r^(1/dim) [P(Fbar) n_a + q (g0_a - g_a)],  q = P(Fbar) : F / dim
//
// Variations, with v = du + (I - F) dd (times n_b: the variation of F) and v0 the same at the
// centroid:
//   dr/r = g0_b . v0 - g_b . v,   dn_a = -n_b (n_a . dd_b),   dg_a = -g_b (g_a . (du_b + dd_b)).
#pragma once

#include <cmath>
#include <gnomon/terms/cell_basis.hpp>
#include <gnomon/terms/neo_hookean.hpp>

namespace gnomon {

enum class ElementKind { plain, f_bar, f_bar_variational };

/// Kinematics of a cell at one reference point.
template <int dim, class Scalar = double>
struct CellPoint {
  Scalar volume;             ///< det(dX/dxi)
  Tensor<dim, Scalar> F;     ///< deformation gradient
  Scalar J;                  ///< det F
  CellNodal<dim, Scalar> n;  ///< rows n_a
  bool valid;                ///< volume > 0 and J > 0

  CellPoint(const CellNodal<dim>& dN, const CellNodal<dim, Scalar>& X,
            const CellNodal<dim, Scalar>& u) {
    const Tensor<dim, Scalar> A = X.transpose() * dN.template cast<Scalar>();
    volume = A.determinant();
    n = dN.template cast<Scalar>() * A.inverse();
    // F from the displacement gradient: rounding then scales with the strain, not the position.
    F = Tensor<dim, Scalar>::Identity() + u.transpose() * n;
    J = F.determinant();
    valid = volume > Scalar(0) && J > Scalar(0);
  }

  /// Rows g_a = F^-T n_a.
  CellNodal<dim, Scalar> spatial_gradients() const { return n * F.inverse(); }
};

/// R [dim x nodes, one row a node] of a cell; false when the cell is inverted. The undeformed
/// configuration X = X^ + d [length], displacement u [length].
template <ElementKind kind, int dim, class Scalar>
bool solid_residual(const NeoHookean& law, const CellNodal<dim, Scalar>& X,
                    const CellNodal<dim, Scalar>& u, CellNodal<dim, Scalar>& R) {
  using std::pow;
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim, Scalar> centre(basis.centroid, X, u);
  if (!centre.valid) return false;
  R.setZero();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim, Scalar> point(dN, X, u);
    if (!point.valid) return false;
    if constexpr (kind == ElementKind::plain) {
      const Tensor<dim, Scalar> P = NeoHookeanPoint<dim, Scalar>(law, point.F).stress();
      R += point.volume * point.n * P.transpose();
    } else {
      const Scalar r = centre.J / point.J;
      const Scalar c = pow(r, 1.0 / dim);
      const Tensor<dim, Scalar> F_bar = c * point.F;
      const Tensor<dim, Scalar> P = NeoHookeanPoint<dim, Scalar>(law, F_bar).stress();
      if constexpr (kind == ElementKind::f_bar) {
        R += (point.volume * c / r) * point.n * P.transpose();
      } else {
        const Scalar q = P.cwiseProduct(point.F).sum() / Scalar(dim);
        R += (point.volume * c) * (point.n * P.transpose() +
                                   q * (centre.spatial_gradients() - point.spatial_gradients()));
      }
    }
  }
  return true;
}

/// Derivatives of the cell residual: K_u = dR/du, and K_d = dR/dd if `with_shape`. Same return
/// value as solid_residual; R is computed along.
template <ElementKind kind, bool with_shape, int dim>
bool solid_tangent(const NeoHookean& law, const CellNodal<dim>& X, const CellNodal<dim>& u,
                   CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d);

/// Runtime choice among the kinds, for callers that read it from a scene.
template <int dim>
struct SolidKernel {
  bool (*residual)(const NeoHookean&, const CellNodal<dim>&, const CellNodal<dim>&,
                   CellNodal<dim>&);
  /// K_d is left alone by `tangent_u`.
  bool (*tangent_u)(const NeoHookean&, const CellNodal<dim>&, const CellNodal<dim>&,
                    CellNodal<dim>&, CellMatrix<dim>&, CellMatrix<dim>&);
  bool (*tangent_ud)(const NeoHookean&, const CellNodal<dim>&, const CellNodal<dim>&,
                     CellNodal<dim>&, CellMatrix<dim>&, CellMatrix<dim>&);

  static SolidKernel of(ElementKind kind);
};

/// Mean over the cell's Gauss points of the von Mises equivalent of the Cauchy stress [stress].
template <int dim>
double equivalent_stress(ElementKind kind, const NeoHookean& law, const CellNodal<dim>& X,
                         const CellNodal<dim>& u);

/// Volume (area in 2D) of a cell [length^dim].
template <int dim>
double cell_volume(const CellNodal<dim>& X);

/// Scaled Jacobian: the least, over the corners, of det(dX/dxi) by the product of the edge lengths
/// that meet there; 1 for a rectangle, <= 0 when inverted.
template <int dim>
double scaled_jacobian(const CellNodal<dim>& X);

}  // namespace gnomon
