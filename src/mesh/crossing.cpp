#include "mesh/crossing.hpp"

namespace gnomon {

template <int dim>
std::vector<std::array<int, dim>> simplices(const typename Mesh<dim>::Facet& facet) {
  if constexpr (dim == 2)
    return {facet};
  else
    return {{facet[0], facet[1], facet[2]}, {facet[0], facet[2], facet[3]}};
}

template <int dim>
Crossing<dim>::Crossing(const Vector<dim>& point, const Vector<dim>& e,
                        const std::array<int, dim>& simplex, const std::vector<Vector<dim>>& x) {
  Tensor<dim> A;  // point + s e = x_0 + sum_k c_k (x_k - x_0)
  A.col(0) = -e;
  for (int k = 1; k < dim; ++k) A.col(k) = x[simplex[k]] - x[simplex[0]];
  Tensor<dim> inverse;
  bool crosses = false;
  A.computeInverseWithCheck(inverse, crosses, 0);
  if (!crosses) return;
  const Vector<dim> solution = inverse * (point - x[simplex[0]]);
  distance = solution[0];
  shares = solution;
  shares[0] = 1 - solution.template tail<dim - 1>().sum();
}

template std::vector<std::array<int, 2>> simplices<2>(const Mesh<2>::Facet&);
template std::vector<std::array<int, 3>> simplices<3>(const Mesh<3>::Facet&);
template struct Crossing<2>;
template struct Crossing<3>;

}  // namespace gnomon
