// What a node of a contact surface between two deformable bodies has beside the mortar sums: its
// normal, the direction of its traction, and the direction in which it wears.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <vector>

namespace gnomon {

/// The normal of a node, unit, out of its body: along the sum of the area vectors of its facets, in
/// the directions in which a symmetry leaves the node.
template <int dim>
struct NodeNormal {
  Vector<dim> value;
  std::vector<Tensor<dim>> by_x;  ///< of each node of the patch

  /// `along`: projector on these directions. Throws RecoverableError where there is none.
  NodeNormal(const ContactPatch<dim>& patch, const PatchNodal<dim>& x, const Tensor<dim>& along);
};

/// tau = n_p - friction s, the traction by its normal component: n_p = -n is the normal out of the
/// partner, s the direction in which the node slides on it; and the speed of sliding.
template <int dim>
struct SlidingTraction {
  using Columns = Eigen::Matrix<double, dim, 2 * dim>;
  Vector<dim> direction;
  Columns direction_by;                        ///< by n, then by the node's position x
  double speed = 0;                            ///< [length / time]
  Eigen::Matrix<double, 1, 2 * dim> speed_by;  ///< by n, then by x

  /// `motion`: of the partner relative to the node's own body.
  SlidingTraction(const ContactPatch<dim>& patch, const Vector<dim>& n, const Vector<dim>& x,
                  const RigidMotion<dim>& motion, double friction);
};

/// The velocity of the shape of a node by the volume that it loses in a time: P N / A, with N and A
/// of NodalSurface, [1 / area].
template <int dim>
struct WearDirection {
  Vector<dim> value;
  std::vector<Tensor<dim>> by_X;  ///< of each node of the patch

  WearDirection(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, NormalRule rule);
};

}  // namespace gnomon
