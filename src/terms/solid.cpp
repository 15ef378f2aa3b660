#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/terms/solid_kernels.hpp>

namespace gnomon {

constinit const LawKernels small_strain_kernels = law_kernels<LinearElasticPoint>;

ElementTechnology technology_of(const std::string& name) {
  for (std::size_t k = 0; k < technology_names.size(); ++k)
    if (name == technology_names[k]) return static_cast<ElementTechnology>(k);
  throw InputError(
      unknown_name(name, "element", {technology_names.begin(), technology_names.end()}));
}

template <int dim>
double cell_volume(const CellNodal<dim>& X, Section section) {
  double sum = 0;
  if constexpr (dim == 2)
    if (section == Section::meridian) {
      for (int g = 0; g < 4; ++g) sum += MeridianPoint<>(g, X, CellNodal<2>::Zero()).volume;
      return sum;
    }
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

template double cell_volume<2>(const CellNodal<2>&, Section);
template double cell_volume<3>(const CellNodal<3>&, Section);
template double scaled_jacobian<2>(const CellNodal<2>&);
template double scaled_jacobian<3>(const CellNodal<3>&);

}  // namespace gnomon
