// Area and normal N of a contact node in the undeformed configuration.
#pragma once

#include <gnomon/base/lift.hpp>
#include <gnomon/mesh/contact_patch.hpp>

namespace gnomon {

/// The direction and length of N, by which a wear rate moves the shape.
///
///   averaged      sum_f A^_f S_f/|S_f| / sum_f A^_f    (A^_f: initial shares, eq. 35)
///   normalised    the same, normalised to length one
///   conservative  A a/|a|^2; a is the derivative of the body's volume with respect to the
///                 position of the node, along the directions in which its shape may move. The
///                 body then loses volume at the rate sum A Wdot, on every mesh.
enum class NormalRule { averaged, normalised, conservative };

template <int dim, class Scalar = double>
struct NodalSurface {
  Scalar area;
  Vector<dim, Scalar> normal;  ///< N; zero if the conservative rule has none

  NodalSurface(const ContactPatch<dim>& patch, const PatchNodal<dim, Scalar>& X, NormalRule rule);
};

/// The derivative of the body's volume by the node's position [length^(dim-1)], along the
/// directions in which its shape may move.
template <int dim, class Scalar>
Vector<dim, Scalar> free_volume_gradient(const ContactPatch<dim>& patch,
                                         const PatchNodal<dim, Scalar>& X) {
  Vector<dim, Scalar> a = Vector<dim, Scalar>::Zero();
  for (const auto* corners : {&patch.corners, &patch.corners_beyond})
    for (const auto& corner : *corners) a += corner_volume_gradient<dim, Scalar>(corner, X);
  return patch.shape_free.template cast<Scalar>() * a;
}

/// Whether the volume that a node removes determines how far it moves, from |a|^2.
inline bool determines_motion(double square, double area) {
  return square > 1e-8 * area * area;
}

template <int dim, class Scalar>
NodalSurface<dim, Scalar>::NodalSurface(const ContactPatch<dim>& patch,
                                        const PatchNodal<dim, Scalar>& X, NormalRule rule) {
  area = Scalar(0);
  normal.setZero();
  const bool conserves = rule == NormalRule::conservative;
  for (const auto& corner : patch.corners) {
    const Vector<dim, Scalar> S = corner_area_vector<dim, Scalar>(corner, X);
    const Scalar size = S.norm();
    area += Scalar(corner.share) * size;
    if (!conserves) normal += Scalar(corner.initial_area / patch.initial_area) * S / size;
  }
  if (rule == NormalRule::normalised) normal /= Scalar(normal.norm());
  if (!conserves) return;
  const Vector<dim, Scalar> a = free_volume_gradient<dim, Scalar>(patch, X);
  if (const Scalar square = a.squaredNorm(); determines_motion(plain(square), plain(area)))
    normal = Scalar(area / square) * a;
}

}  // namespace gnomon
