// Sliding velocity of a contact node, eq. (6) and (7), from the rigid-body motion of the two
// bodies.
//
// The worn body streams with V through its undeformed configuration, so that its points move with
// F V in the current one. V is tangent to the surface, and each facet of the node gives F V from
// its edges at the node, T_j = X_j - X_0 undeformed and t_j = x_j - x_0 current:
//
//   V = sum_j c_j T_j   (least squares: c = (T'T)^-1 T'V),   F V = sum_j c_j t_j,
//
// averaged like the normal, with the initial areas of the facets. With the velocity v^2 of the
// counter-body and its normal n:  v_T = (1 - n n') (F V - v^2). In 2D the counter-body may also
// slide out of the plane, with v_z, and where it turns, v = (v_T, v_z) differs over the share of
// surface that belongs to the node X_0:
//
//   speed = (|v|^2 + variance / 3)^(1/2),   variance = mean of |v(X) - v(X_0)|^2 over the share.
//
// A node about which the counter-body turns is so worn like its neighbours (docs/equations.md).
#pragma once

#include <cmath>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/shapes/counter_body.hpp>

namespace gnomon {

/// F V of a node [length / time].
template <int dim, class Scalar>
Vector<dim, Scalar> streaming_velocity(const ContactPatch<dim>& patch,
                                       const PatchNodal<dim, Scalar>& X,
                                       const PatchNodal<dim, Scalar>& x,
                                       const Vector<dim>& streaming) {
  Vector<dim, Scalar> result = Vector<dim, Scalar>::Zero();
  if (streaming.isZero(0)) return result;
  for (const auto& corner : patch.corners) {
    const auto T = corner_edges<dim, Scalar>(corner, X);
    const auto t = corner_edges<dim, Scalar>(corner, x);
    const Eigen::Matrix<Scalar, dim - 1, dim - 1> G = (T.transpose() * T).inverse();
    const Eigen::Matrix<Scalar, dim - 1, 1> c =
        G * (T.transpose() * streaming.template cast<Scalar>());
    result += Scalar(corner.initial_area / patch.initial_area) * (t * c);
  }
  return result;
}

/// The variance above, by the initial share and normal of the node and the derivatives of the
/// partner's velocity and of that out of the plane [(length / time)^2].
template <int dim>
double velocity_variance(const ContactPatch<dim>& patch, const Tensor<dim>& velocity_by_x,
                         const Vector<dim>& across_by_x) {
  double result = across_by_x.dot(patch.initial_spread * across_by_x);
  if (velocity_by_x.isZero(0)) return result;
  const Vector<dim>& N = patch.initial_normal;
  const Tensor<dim> along = velocity_by_x - N * (N.transpose() * velocity_by_x);
  return result + (along * patch.initial_spread * along.transpose()).trace();
}

/// Tangential part of a relative velocity: the speed and v_T/speed, zero if there is no sliding.
template <int dim, class Scalar = double>
struct Sliding {
  Scalar speed;
  Vector<dim, Scalar> direction;

  Sliding(const Vector<dim, Scalar>& relative, const Vector<dim, Scalar>& normal,
          const Scalar& across = Scalar(0), double variance = 0) {
    using std::sqrt;
    const Vector<dim, Scalar> tangential = relative - normal * normal.dot(relative);
    const Scalar square = tangential.squaredNorm() + across * across + Scalar(variance / 3);
    if (square > Scalar(0)) {
      speed = sqrt(square);
      direction = tangential / speed;
    } else {
      speed = Scalar(0);
      direction.setZero();
    }
  }
};

/// Derivatives of streaming_velocity with respect to the undeformed (X) and current (x) positions
/// of the patch.
template <int dim>
struct StreamingVelocityDerivative {
  std::array<Tensor<dim>, max_patch_nodes> by_X, by_x;

  StreamingVelocityDerivative(const ContactPatch<dim>& patch, const PatchNodal<dim>& X,
                              const PatchNodal<dim>& x, const Vector<dim>& streaming) {
    for (std::size_t p = 0; p < patch.nodes.size(); ++p) by_X[p].setZero(), by_x[p].setZero();
    for (const auto& corner : patch.corners) {
      const double weight = corner.initial_area / patch.initial_area;
      const auto T = corner_edges<dim, double>(corner, X);
      const auto t = corner_edges<dim, double>(corner, x);
      const Eigen::Matrix<double, dim - 1, dim - 1> G = (T.transpose() * T).inverse();
      const Eigen::Matrix<double, dim - 1, 1> c = G * (T.transpose() * streaming);
      const Vector<dim> off = streaming - T * c;  // the part that is not along the facet
      const Eigen::Matrix<double, dim, dim - 1> t_G = t * G;
      for (int j = 1; j < dim; ++j) {
        // dc = -G T' dT_j c_j + G e_j (dT_j . off)
        const Tensor<dim> by_edge =
            weight * (t_G.col(j - 1) * off.transpose() - c[j - 1] * t_G * T.transpose());
        by_X[corner.nodes[j]] += by_edge;
        by_X[corner.nodes[0]] -= by_edge;
        by_x[corner.nodes[j]] += weight * c[j - 1] * Tensor<dim>::Identity();
        by_x[corner.nodes[0]] -= weight * c[j - 1] * Tensor<dim>::Identity();
      }
    }
  }
};

}  // namespace gnomon
