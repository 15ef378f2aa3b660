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
// slide out of the plane, with v_z: then the speed is (|v_T|^2 + v_z^2)^(1/2).
#pragma once

#include <cmath>
#include <gnomon/mesh/contact_patch.hpp>

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

/// Tangential part of a relative velocity: |v_T| and v_T/|v_T|, zero if there is no sliding.
template <int dim, class Scalar = double>
struct Sliding {
  Scalar speed;
  Vector<dim, Scalar> direction;

  Sliding(const Vector<dim, Scalar>& relative, const Vector<dim, Scalar>& normal,
          const Scalar& across = Scalar(0)) {
    using std::sqrt;
    const Vector<dim, Scalar> tangential = relative - normal * normal.dot(relative);
    const Scalar square = tangential.squaredNorm() + across * across;
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
                              const PatchNodal<dim>& x, const Vector<dim>& streaming);
};

}  // namespace gnomon
