// Derivatives of the area vectors and volume gradients of contact_patch.hpp with respect to the
// positions of the corner's nodes.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>

namespace gnomon {

/// The skew matrix with skew(a) w = a x w.
inline Tensor<3> skew(const Vector<3>& a) {
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// dS/dX of the corner's nodes, in the order of corner.nodes.
template <int dim>
std::array<Tensor<dim>, dim> area_vector_derivative(
    const typename ContactPatch<dim>::Corner& corner, const PatchNodal<dim>& X) {
  if constexpr (dim == 2) {
    Tensor<2> turn = corner.sign / 2 * Tensor<2>{{0, 1}, {-1, 0}};
    if (corner.section == Section::plane) return {Tensor<2>(-turn), turn};
    const Vector<2> flat = turn * corner_edges<2, double>(corner, X);
    const Tensor<2> by_radius = 2 * M_PI / 3 * flat * Vector<2>::Unit(0).transpose();
    turn *= corner_circumference<double>(corner, X);
    return {Tensor<2>(2 * by_radius - turn), Tensor<2>(by_radius + turn)};
  } else {
    const Vector<3> a = (X.row(corner.nodes[1]) - X.row(corner.nodes[0])).transpose();
    const Vector<3> b = (X.row(corner.nodes[2]) - X.row(corner.nodes[0])).transpose();
    const Tensor<3> by_a = -skew(b) / 4;
    const Tensor<3> by_b = skew(a) / 4;
    return {Tensor<3>(-by_a - by_b), by_a, by_b};
  }
}

/// The derivative of corner_volume_gradient with respect to the corner's nodes, in the order of
/// corner.nodes.
template <int dim>
std::array<Tensor<dim>, (1 << (dim - 1))> volume_gradient_derivative(
    const typename ContactPatch<dim>::Corner& corner, const PatchNodal<dim>& X) {
  if constexpr (dim == 2) {
    return area_vector_derivative<dim>(corner, X);
  } else {
    const auto along = corner_volume_edges<double>(corner, X);
    const Tensor<3> by_first = -skew(along[1]) / 36, by_second = skew(along[0]) / 36;
    return {Tensor<3>(-2 * by_first - 2 * by_second), Tensor<3>(2 * by_first - by_second),
            Tensor<3>(2 * by_second - by_first), Tensor<3>(by_first + by_second)};
  }
}

}  // namespace gnomon
