// An elastic cell whose reference configuration moves: residual of eq. (24), integrated over the
// undeformed configuration X = X^ + d, and its derivatives with respect to u and to d.
//
//   H = (du/dxi)(dX/dxi)^-1,   F = I + H,   n_a = (dX/dxi)^-T dN_a/dxi,
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
//   plain_blatz_ko     as plain, by the law of Blatz and Ko: for the mesh motion
//
// The small-strain kinds are these linearised in u at u = 0, over the same X: with
//   Hbar = H + (tr H_0 - tr H)/dim I,   sigma linear elastic, g_a = n_a,
//
//   small_plain              R_a = sum_g det(dX/dxi) sigma(H) n_a
//   small_f_bar              R_a = sum_g det(dX/dxi) sigma(Hbar) n_a
//   small_f_bar_variational  R_a = sum_g det(dX/dxi) [sigma(Hbar) n_a + q (n0_a - n_a)],
//                            q = tr sigma(Hbar) / dim
//
// Variations, with v = du - H dd (times n_b: the variation of H) and v0 the same at the centroid:
//   dr/r = g0_b . v0 - g_b . v,   dn_a = -n_b (n_a . dd_b),   dg_a = -g_b (g_a . (du_b + dd_b)).
#pragma once

#include <cmath>
#include <gnomon/laws/blatz_ko.hpp>
#include <gnomon/laws/linear_elastic.hpp>
#include <gnomon/mesh/cell_basis.hpp>
#include <type_traits>

namespace gnomon {

enum class ElementKind {
  plain,
  f_bar,
  f_bar_variational,
  plain_blatz_ko,
  small_plain,
  small_f_bar,
  small_f_bar_variational
};

constexpr bool small_strain(ElementKind kind) {
  return kind >= ElementKind::small_plain;
}
/// Whether the change of volume is that of the centroid.
constexpr bool averaged(ElementKind kind) {
  return kind != ElementKind::plain && kind != ElementKind::plain_blatz_ko &&
         kind != ElementKind::small_plain;
}
constexpr bool variational(ElementKind kind) {
  return kind == ElementKind::f_bar_variational || kind == ElementKind::small_f_bar_variational;
}
/// The small-strain kind that a finite-strain one of the body becomes in the limit of small
/// displacements.
constexpr ElementKind small_strain_limit(ElementKind kind) {
  return kind == ElementKind::plain   ? ElementKind::small_plain
         : kind == ElementKind::f_bar ? ElementKind::small_f_bar
                                      : ElementKind::small_f_bar_variational;
}

/// Kinematics of a cell at one reference point.
template <int dim, class Scalar = double>
struct CellPoint {
  Scalar volume;             ///< det(dX/dxi)
  CellNodal<dim, Scalar> n;  ///< rows n_a
  Tensor<dim, Scalar> H;     ///< displacement gradient
  Tensor<dim, Scalar> F;     ///< deformation gradient
  Scalar J;                  ///< det F

  CellPoint(const CellNodal<dim>& dN, const CellNodal<dim, Scalar>& X,
            const CellNodal<dim, Scalar>& u) {
    const Tensor<dim, Scalar> A = X.transpose() * dN.template cast<Scalar>();
    volume = A.determinant();
    n = dN.template cast<Scalar>() * A.inverse();
    // F from the displacement gradient: rounding then scales with the strain, not the position.
    H = u.transpose() * n;
    F = Tensor<dim, Scalar>::Identity() + H;
    J = F.determinant();
  }

  /// Whether the cell is not inverted here; with small strains only its reference can be.
  bool valid(ElementKind kind) const {
    return volume > Scalar(0) && (small_strain(kind) || J > Scalar(0));
  }

  /// Rows g_a = F^-T n_a.
  CellNodal<dim, Scalar> spatial_gradients() const { return n * F.inverse(); }
};

/// The law at a Gauss point, whose change of volume may be that of the centroid.
template <ElementKind kind, int dim, class Scalar = double>
struct MaterialPoint {
  using T = Tensor<dim, Scalar>;
  using Cell = CellPoint<dim, Scalar>;
  using FiniteLaw = std::conditional_t<kind == ElementKind::plain_blatz_ko,
                                       BlatzKoPoint<dim, Scalar>, NeoHookeanPoint<dim, Scalar>>;
  using Law = std::conditional_t<small_strain(kind), LinearElasticPoint<dim, Scalar>, FiniteLaw>;

  Scalar c;  ///< r^(1/dim), 1 with small strains
  T strain;  ///< what the law is evaluated at: F, Fbar, H or Hbar
  Law law;
  Scalar weight;  ///< factor of P n_a in R_a

  MaterialPoint(const NeoHookean& material, const Cell& centre, const Cell& point)
      : c(stretch(centre, point)),
        strain(strain_of(centre, point)),
        law(material, strain),
        weight(point.volume) {
    if constexpr (kind == ElementKind::f_bar) weight = point.volume * c * point.J / centre.J;
    if constexpr (kind == ElementKind::f_bar_variational) weight = point.volume * c;
  }

private:
  static Scalar stretch(const Cell& centre, const Cell& point) {
    using std::pow;
    if constexpr (averaged(kind) && !small_strain(kind))
      return pow(Scalar(centre.J / point.J), 1.0 / dim);
    else
      return Scalar(1);
  }
  T strain_of(const Cell& centre, const Cell& point) const {
    if constexpr (small_strain(kind) && averaged(kind))
      return point.H + Scalar((centre.H.trace() - point.H.trace()) / Scalar(dim)) * T::Identity();
    else if constexpr (small_strain(kind))
      return point.H;
    else if constexpr (averaged(kind))
      return c * point.F;
    else
      return point.F;
  }
};

/// R [dim x nodes, one row a node] of a cell; false when the cell is inverted. The undeformed
/// configuration X = X^ + d [length], displacement u [length].
template <ElementKind kind, int dim, class Scalar>
bool solid_residual(const NeoHookean& law, const CellNodal<dim, Scalar>& X,
                    const CellNodal<dim, Scalar>& u, CellNodal<dim, Scalar>& R) {
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim, Scalar> centre(basis.centroid, X, u);
  if (!centre.valid(kind)) return false;
  R.setZero();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim, Scalar> point(dN, X, u);
    if (!point.valid(kind)) return false;
    const MaterialPoint<kind, dim, Scalar> material(law, centre, point);
    const Tensor<dim, Scalar> P = material.law.stress();
    R += material.weight * point.n * P.transpose();
    if constexpr (kind == ElementKind::f_bar_variational)
      R += Scalar(material.weight * P.cwiseProduct(point.F).sum() / Scalar(dim)) *
           (centre.spatial_gradients() - point.spatial_gradients());
    if constexpr (kind == ElementKind::small_f_bar_variational)
      R += Scalar(material.weight * P.trace() / Scalar(dim)) * (centre.n - point.n);
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
/// With small strains sigma takes its place.
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
