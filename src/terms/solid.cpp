#include <gnomon/terms/solid.hpp>

namespace gnomon {

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
    case ElementKind::f_bar_variational:
      return make.template operator()<ElementKind::f_bar_variational>();
    case ElementKind::plain_blatz_ko:
      return make.template operator()<ElementKind::plain_blatz_ko>();
    case ElementKind::small_plain:
      return make.template operator()<ElementKind::small_plain>();
    case ElementKind::small_f_bar:
      return make.template operator()<ElementKind::small_f_bar>();
    default:
      return make.template operator()<ElementKind::small_f_bar_variational>();
  }
}

namespace {

/// Deviatoric part of the Cauchy stress at a Gauss point; one tensor for both dimensions.
template <ElementKind kind, int dim>
Tensor<3> stress_deviator(const NeoHookean& law, const CellPoint<dim>& centre,
                          const CellPoint<dim>& point) {
  const MaterialPoint<kind, dim> material(law, centre, point);
  Tensor<3> sigma = Tensor<3>::Zero();
  sigma.topLeftCorner<dim, dim>() = material.law.stress();
  if constexpr (!small_strain(kind))
    sigma.topLeftCorner<dim, dim>() *= material.strain.transpose() / material.law.J();
  if constexpr (dim == 2) sigma(2, 2) = material.law.out_of_plane_stress();
  return sigma - sigma.trace() / 3 * Tensor<3>::Identity();
}

}  // namespace

template <int dim>
double equivalent_stress(ElementKind kind, const NeoHookean& law, const CellNodal<dim>& X,
                         const CellNodal<dim>& u) {
  // Both f-bar kinds evaluate the law at the same strain.
  const auto deviator = kind == ElementKind::plain ? &stress_deviator<ElementKind::plain, dim>
                        : kind == ElementKind::small_plain
                            ? &stress_deviator<ElementKind::small_plain, dim>
                        : small_strain(kind) ? &stress_deviator<ElementKind::small_f_bar, dim>
                                             : &stress_deviator<ElementKind::f_bar, dim>;
  const auto& basis = CellBasis<dim>::instance();
  const CellPoint<dim> centre(basis.centroid, X, u);
  double sum = 0;
  for (const CellNodal<dim>& dN : basis.gauss)
    sum += std::sqrt(1.5) * deviator(law, centre, CellPoint<dim>(dN, X, u)).norm();
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
