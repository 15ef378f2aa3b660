// Bilinear and trilinear basis functions on the reference cell [-1, 1]^dim.
#pragma once

#include <array>
#include <cmath>
#include <gnomon/base/tensor.hpp>

namespace gnomon {

/// Corner of the reference cell, VTK order.
template <int dim>
Vector<dim> reference_corner(int node) {
  Vector<dim> corner;
  corner[0] = (node % 4 == 1 || node % 4 == 2) ? 1 : -1;
  corner[1] = (node % 4 >= 2) ? 1 : -1;
  if constexpr (dim == 3) corner[2] = node >= 4 ? 1 : -1;
  return corner;
}

/// Values N_a at a reference point, one per node.
template <int dim>
Eigen::Matrix<double, 1 << dim, 1> basis_values(const Vector<dim>& xi) {
  Eigen::Matrix<double, 1 << dim, 1> values;
  for (int a = 0; a < (1 << dim); ++a)
    values[a] = ((reference_corner<dim>(a).array() * xi.array() + 1) / 2).prod();
  return values;
}

/// Gradients dN_a/dxi at a reference point; one row per node.
template <int dim>
CellNodal<dim> basis_gradients(const Vector<dim>& xi) {
  CellNodal<dim> gradients;
  for (int a = 0; a < (1 << dim); ++a) {
    const Vector<dim> corner = reference_corner<dim>(a);
    for (int i = 0; i < dim; ++i) {
      double value = corner[i] / (1 << dim);
      for (int j = 0; j < dim; ++j)
        if (j != i) value *= 1 + corner[j] * xi[j];
      gradients(a, i) = value;
    }
  }
  return gradients;
}

/// Basis gradients, and values, at the points where cells are evaluated, computed once.
template <int dim>
struct CellBasis {
  static constexpr int points = 1 << dim;  ///< 2^dim Gauss points, all of weight one
  std::array<CellNodal<dim>, points> gauss;
  std::array<Eigen::Matrix<double, 1 << dim, 1>, points> gauss_values;
  std::array<CellNodal<dim>, points> corners;  ///< at the nodes
  CellNodal<dim> centroid;

  static const CellBasis& instance() {
    static const CellBasis basis;
    return basis;
  }

private:
  CellBasis() {
    for (int g = 0; g < points; ++g) {
      gauss[g] = basis_gradients<dim>(reference_corner<dim>(g) / std::sqrt(3.0));
      gauss_values[g] = basis_values<dim>(reference_corner<dim>(g) / std::sqrt(3.0));
      corners[g] = basis_gradients<dim>(reference_corner<dim>(g));
    }
    centroid = basis_gradients<dim>(Vector<dim>::Zero());
  }
};

}  // namespace gnomon
