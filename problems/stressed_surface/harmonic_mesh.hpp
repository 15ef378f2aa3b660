// A mesh motion that is linear: every component of d is harmonic in the initial configuration, with
// a weight for each direction. With the weights (0, 1) nodes on lines along y keep their order
// there, however sharp the surface becomes.
#pragma once

#include <gnomon/terms/material.hpp>
#include <gnomon/terms/solid_kernels.hpp>

namespace gnomon::stressed {

/// phi = (F - I) diag(weights) : (F - I) / 2. Its weights come in the place of the moduli.
template <int dim, class Scalar = double>
class HarmonicPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::finite;

  HarmonicPoint(const ElasticModuli& weights, const T& F)
      : weights_(weights), H_(F - T::Identity()) {}

  Scalar energy() const { return stress().cwiseProduct(H_).sum() / Scalar(2); }
  T stress() const { return stress_change(H_); }
  T stress_change(const T& dF) const {
    T P = Scalar(weights_.mu) * dF;
    P.col(0) = Scalar(weights_.lambda) * dF.col(0);
    return P;
  }

private:
  ElasticModuli weights_;
  T H_;
};

/// Mesh motion is that of plain elements in the plane.
inline constexpr LawKernels harmonic_kernels = {
    .plane = {cell_kernel<ElementTechnology::plain, HarmonicPoint, 2>},
    .space = {},
    .meridian = {}};

/// For MeshMotion: the law P = (F - I) diag(weights), whose plain elements have the matrix of
/// harmonic_matrix().
inline Material harmonic_material(const Vector<2>& weights) {
  return {.moduli = {weights[0], weights[1]}, .finite_kernels = &harmonic_kernels};
}

/// K_ab = sum_g det(dX^/dxi) n_a . diag(weights) n_b of a cell, for each component.
inline Eigen::Matrix4d harmonic_matrix(const Vector<2>& weights, const CellNodal<2>& initial) {
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  for (const CellNodal<2>& dN : CellBasis<2>::instance().gauss) {
    const CellPoint<2> point(dN, initial, CellNodal<2>::Zero());
    K += point.volume * point.n * weights.asDiagonal() * point.n.transpose();
  }
  return K;
}

}  // namespace gnomon::stressed
