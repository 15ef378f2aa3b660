#include <gnomon/terms/solid.hpp>

namespace gnomon {

namespace {

// Contributions of one Gauss point to the block (a, b) are collected as factors of the variations
// v, v0, dx = du + dd and dX = dd (see the header), then turned into derivatives by u and d.
template <int dim>
struct PointState {
  const CellPoint<dim>& point;
  const CellPoint<dim>& centre;
  const CellNodal<dim>& g;   // rows g_a
  const CellNodal<dim>& g0;  // rows g0_a
};

template <bool with_shape, int dim>
void add_plain(const NeoHookean& law, const CellPoint<dim>& point, CellNodal<dim>& R,
               CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  const NeoHookeanPoint<dim> material(law, point.F);
  const CellNodal<dim> Pn = point.n * material.stress().transpose();  // rows P n_a
  const Tensor<dim> I_F = Tensor<dim>::Identity() - point.F;
  R += point.volume * Pn;
  for (int b = 0; b < (1 << dim); ++b)
    for (int a = 0; a < (1 << dim); ++a) {
      const Tensor<dim> K_v = point.volume * material.stress_block(point.n.row(a), point.n.row(b));
      K_u.template block<dim, dim>(dim * a, dim * b) += K_v;
      if constexpr (with_shape)
        K_d.template block<dim, dim>(dim * a, dim * b) +=
            K_v * I_F + point.volume * (Pn.row(a).transpose() * point.n.row(b) -
                                        Pn.row(b).transpose() * point.n.row(a));
    }
}

template <bool with_shape, int dim>
void add_f_bar(const NeoHookean& law, const PointState<dim>& s, CellNodal<dim>& R,
               CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  const double r = s.centre.J / s.point.J;
  const double c = std::pow(r, 1.0 / dim);
  const double m = s.point.volume * c / r;
  const Tensor<dim> F_bar = c * s.point.F;
  const NeoHookeanPoint<dim> material(law, F_bar);
  const CellNodal<dim>& n = s.point.n;
  const CellNodal<dim> Pn = n * material.stress().transpose();
  // h_a: derivative of r^(1/dim - 1) P(Fbar) n_a by log r, without the factor r^(1/dim - 1).
  const CellNodal<dim> h =
      (1.0 / dim - 1) * Pn + (1.0 / dim) * n * material.stress_change(F_bar).transpose();
  const Tensor<dim> I_F = Tensor<dim>::Identity() - s.point.F;
  const Tensor<dim> I_F0 = Tensor<dim>::Identity() - s.centre.F;
  R += m * Pn;
  for (int b = 0; b < (1 << dim); ++b)
    for (int a = 0; a < (1 << dim); ++a) {
      const Tensor<dim> K_v =
          m * (c * material.stress_block(n.row(a), n.row(b)) - h.row(a).transpose() * s.g.row(b));
      const Tensor<dim> K_v0 = m * h.row(a).transpose() * s.g0.row(b);
      K_u.template block<dim, dim>(dim * a, dim * b) += K_v + K_v0;
      if constexpr (with_shape)
        K_d.template block<dim, dim>(dim * a, dim * b) +=
            K_v * I_F + K_v0 * I_F0 +
            m * (Pn.row(a).transpose() * n.row(b) - Pn.row(b).transpose() * n.row(a));
    }
}

template <bool with_shape, int dim>
void add_f_bar_variational(const NeoHookean& law, const PointState<dim>& s, CellNodal<dim>& R,
                           CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  const double c = std::pow(s.centre.J / s.point.J, 1.0 / dim);
  const double m = s.point.volume * c;
  const Tensor<dim> F_bar = c * s.point.F;
  const NeoHookeanPoint<dim> material(law, F_bar);
  const CellNodal<dim>& n = s.point.n;
  const Tensor<dim> P = material.stress();
  const Tensor<dim> Z = material.stress_change(F_bar);
  const double q = P.cwiseProduct(s.point.F).sum() / dim;
  const CellNodal<dim> Pn = n * P.transpose();
  const CellNodal<dim> e = s.g0 - s.g;
  const CellNodal<dim> S = Pn + q * e;
  const CellNodal<dim> dq = (n * Z.transpose() + Pn) / dim;  // rows: dq/dv_b
  const CellNodal<dim> k = (S + n * Z.transpose()) / dim +
                           (Z.cwiseProduct(F_bar).sum() / (dim * dim * c)) * e;  // dS_a / dlog r
  const Tensor<dim> I_F = Tensor<dim>::Identity() - s.point.F;
  const Tensor<dim> I_F0 = Tensor<dim>::Identity() - s.centre.F;
  R += m * S;
  for (int b = 0; b < (1 << dim); ++b)
    for (int a = 0; a < (1 << dim); ++a) {
      const Tensor<dim> K_v =
          m * (c * material.stress_block(n.row(a), n.row(b)) + e.row(a).transpose() * dq.row(b) -
               k.row(a).transpose() * s.g.row(b));
      const Tensor<dim> K_v0 = m * k.row(a).transpose() * s.g0.row(b);
      const Tensor<dim> K_x =
          m * q * (s.g.row(b).transpose() * s.g.row(a) - s.g0.row(b).transpose() * s.g0.row(a));
      K_u.template block<dim, dim>(dim * a, dim * b) += K_v + K_v0 + K_x;
      if constexpr (with_shape)
        K_d.template block<dim, dim>(dim * a, dim * b) +=
            K_v * I_F + K_v0 * I_F0 + K_x +
            m * (S.row(a).transpose() * n.row(b) - Pn.row(b).transpose() * n.row(a));
    }
}

}  // namespace

template <ElementKind kind, bool with_shape, int dim>
bool solid_tangent(const NeoHookean& law, const CellNodal<dim>& X, const CellNodal<dim>& u,
                   CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d) {
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  if (!centre.valid) return false;
  R.setZero();
  K_u.setZero();
  if constexpr (with_shape) K_d.setZero();
  const CellNodal<dim> g0 = centre.spatial_gradients();
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim> point(dN, X, u);
    if (!point.valid) return false;
    if constexpr (kind == ElementKind::plain) {
      add_plain<with_shape>(law, point, R, K_u, K_d);
    } else {
      const CellNodal<dim> g = point.spatial_gradients();
      const PointState<dim> state{point, centre, g, g0};
      if constexpr (kind == ElementKind::f_bar)
        add_f_bar<with_shape>(law, state, R, K_u, K_d);
      else
        add_f_bar_variational<with_shape>(law, state, R, K_u, K_d);
    }
  }
  return true;
}

template <int dim>
SolidKernel<dim> SolidKernel<dim>::of(ElementKind kind) {
  const auto make = []<ElementKind k>() {
    return SolidKernel{&solid_residual<k, dim, double>, &solid_tangent<k, false, dim>,
                       &solid_tangent<k, true, dim>};
  };
  switch (kind) {
    case ElementKind::plain:
      return make.template operator()<ElementKind::plain>();
    case ElementKind::f_bar:
      return make.template operator()<ElementKind::f_bar>();
    default:
      return make.template operator()<ElementKind::f_bar_variational>();
  }
}

template <int dim>
double equivalent_stress(ElementKind kind, const NeoHookean& law, const CellNodal<dim>& X,
                         const CellNodal<dim>& u) {
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  double sum = 0;
  for (const CellNodal<dim>& dN : basis.gauss) {
    const CellPoint<dim> point(dN, X, u);
    const double c = kind == ElementKind::plain ? 1 : std::pow(centre.J / point.J, 1.0 / dim);
    const Tensor<dim> F = c * point.F;
    const NeoHookeanPoint<dim> material(law, F);
    Tensor<3> sigma = Tensor<3>::Zero();
    sigma.topLeftCorner<dim, dim>() = material.stress() * F.transpose() / material.J();
    if constexpr (dim == 2) sigma(2, 2) = material.out_of_plane_stress();
    const Tensor<3> deviator = sigma - sigma.trace() / 3 * Tensor<3>::Identity();
    sum += std::sqrt(1.5) * deviator.norm();
  }
  return sum / CellBasis<dim>::points;
}

template <int dim>
double cell_volume(const CellNodal<dim>& X) {
  double sum = 0;
  for (const CellNodal<dim>& dN : CellBasis<dim>::instance().gauss)
    sum += (X.transpose() * dN).determinant();
  return sum;
}

template <int dim>
double scaled_jacobian(const CellNodal<dim>& X) {
  double least = 1;
  for (const CellNodal<dim>& dN : CellBasis<dim>::instance().corners) {
    const Tensor<dim> A = X.transpose() * dN;
    least = std::min(least, A.determinant() / A.colwise().norm().prod());
  }
  return least;
}

#define GNOMON_INSTANTIATE(dim)                                                                 \
  template struct SolidKernel<dim>;                                                             \
  template double equivalent_stress<dim>(ElementKind, const NeoHookean&, const CellNodal<dim>&, \
                                         const CellNodal<dim>&);                                \
  template double cell_volume<dim>(const CellNodal<dim>&);                                      \
  template double scaled_jacobian<dim>(const CellNodal<dim>&);
GNOMON_INSTANTIATE(2)
GNOMON_INSTANTIATE(3)
#undef GNOMON_INSTANTIATE

}  // namespace gnomon
