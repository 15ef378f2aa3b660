#include <gnomon/terms/solid.hpp>

#include "terms/dyad_sums.hpp"

namespace gnomon {

namespace {

template <int dim>
struct Gradients {
  CellNodal<dim> g;  ///< rows g_a; n_a with small strains
  CellNodal<dim> p;  ///< rows -H^T g_a: g_b . v = g_b . du_b + p_b . dd_b

  Gradients(ElementKind kind, const CellPoint<dim>& point)
      : g(small_strain(kind) ? point.n : point.spatial_gradients()), p(-g * point.H) {}
};

/// Terms of docs/equations.md, Gauss point by Gauss point; weights are put into the factors.
template <ElementKind kind, bool with_shape, int dim>
class CellTangent {
public:
  using Nodal = CellNodal<dim>;

  CellTangent(const NeoHookean& law, const CellPoint<dim>& centre)
      : law_(law), centre_(centre), at_centre_(kind, centre) {}

  void add(const CellPoint<dim>& point, CellNodal<dim>& R);
  void write(CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) const {
    by_u_.write(K_u);
    if constexpr (with_shape) by_d_.write(K_d);
  }

private:
  static constexpr bool small = small_strain(kind);
  static constexpr int direct_dyads = 1 + averaged(kind) + variational(kind);

  const NeoHookean& law_;
  const CellPoint<dim>& centre_;
  Gradients<dim> at_centre_;
  TangentSum<dim, direct_dyads, 1 + (variational(kind) && !small)> by_u_;
  TangentSum<dim, direct_dyads + 1, 2 + 2 * variational(kind)> by_d_;
};

template <ElementKind kind, bool with_shape, int dim>
void CellTangent<kind, with_shape, dim>::add(const CellPoint<dim>& point, CellNodal<dim>& R) {
  const MaterialPoint<kind, dim> at(law_, centre_, point);
  const double m = at.weight, c = at.c;
  const Gradients<dim> here(kind, point);
  const Nodal &n = point.n, &g = here.g, &p = here.p, &g0 = at_centre_.g, &p0 = at_centre_.p;
  const Tensor<dim> P = at.law.stress();
  const Nodal Pn = m * n * P.transpose();
  const double volumetric = m * at.law.volumetric() / c, geometric = m * at.law.geometric() / c,
               shear = m * c * at.law.shear();
  double crossed = geometric;  // factor of g_b (x) g_a in K_u
  Nodal S = Pn;
  if constexpr (averaged(kind)) {
    Tensor<dim> B = Tensor<dim>::Identity();  // what a change of volume adds to the strain
    if constexpr (!small) B = at.strain;
    const Tensor<dim> Z = at.law.stress_change(B);
    const Nodal Zn = m * n * Z.transpose();
    Nodal h = Zn / dim;
    if constexpr (kind == ElementKind::f_bar) h += (1.0 / dim - 1) * Pn;
    if constexpr (variational(kind)) {
      const double q = m * P.cwiseProduct(B).sum() / (dim * c);
      const Nodal e = g0 - g;
      Nodal dq = Zn / dim;
      S += q * e;
      h += (m * Z.cwiseProduct(B).sum() / (dim * dim * c)) * e;
      if constexpr (!small) h += S / dim, dq += Pn / dim;
      by_u_.direct.add(e, dq);
      if constexpr (!small) crossed += q, by_u_.crossed.add(g0, -q * g0);
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
  by_u_.direct.add(g, volumetric * g);
  by_u_.crossed.add(g, crossed * g);
  by_u_.pairs.add(n, shear * Tensor<dim>::Identity());
  if constexpr (with_shape) {
    by_d_.direct.add(g, volumetric * p);
    by_d_.direct.add(S, n);
    by_d_.crossed.add(p, geometric * g);
    by_d_.crossed.add(n, -Pn);
    by_d_.pairs.add(n, -shear * point.H);
  }
}

}  // namespace

template <ElementKind kind, bool with_shape, int dim>
bool solid_tangent(const NeoHookean& law, const CellNodal<dim>& X, const CellNodal<dim>& u,
                   CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  if (!centre.valid(kind)) return false;
  CellTangent<kind, with_shape, dim> tangent(law, centre);
  R.setZero();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim> point(dN, X, u);
    if (!point.valid(kind)) return false;
    tangent.add(point, R);
  }
  tangent.write(K_u, K_d);
  return true;
}

#define GNOMON_INSTANTIATE(kind, dim)                                                     \
  template bool solid_tangent<kind, false, dim>(const NeoHookean&, const CellNodal<dim>&, \
                                                const CellNodal<dim>&, CellNodal<dim>&,   \
                                                CellMatrix<dim>&, CellMatrix<dim>&);      \
  template bool solid_tangent<kind, true, dim>(const NeoHookean&, const CellNodal<dim>&,  \
                                               const CellNodal<dim>&, CellNodal<dim>&,    \
                                               CellMatrix<dim>&, CellMatrix<dim>&);
#define GNOMON_INSTANTIATE_BOTH(kind) GNOMON_INSTANTIATE(kind, 2) GNOMON_INSTANTIATE(kind, 3)
GNOMON_INSTANTIATE_BOTH(ElementKind::plain)
GNOMON_INSTANTIATE_BOTH(ElementKind::f_bar)
GNOMON_INSTANTIATE_BOTH(ElementKind::f_bar_variational)
GNOMON_INSTANTIATE_BOTH(ElementKind::plain_blatz_ko)
GNOMON_INSTANTIATE_BOTH(ElementKind::small_plain)
GNOMON_INSTANTIATE_BOTH(ElementKind::small_f_bar)
GNOMON_INSTANTIATE_BOTH(ElementKind::small_f_bar_variational)
#undef GNOMON_INSTANTIATE_BOTH
#undef GNOMON_INSTANTIATE

}  // namespace gnomon
