// Small fixed-size vectors and matrices of the kernels.
#pragma once

#include <Eigen/Dense>

namespace gnomon {

template <int dim, class Scalar = double>
using Vector = Eigen::Matrix<Scalar, dim, 1>;

template <int dim, class Scalar = double>
using Tensor = Eigen::Matrix<Scalar, dim, dim>;

/// One row per node of a 4-node (2D) or 8-node (3D) cell.
template <int dim, class Scalar = double>
using CellNodal = Eigen::Matrix<Scalar, 1 << dim, dim>;

/// Tangent of a cell: row and column dim * node + component.
template <int dim>
using CellMatrix = Eigen::Matrix<double, dim*(1 << dim), dim*(1 << dim)>;

}  // namespace gnomon
