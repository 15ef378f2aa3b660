// Where a body is in a phase of a cycle, and how its material moves there: the elastic problem
// stays in the frame of the body.
#pragma once

#include <gnomon/shapes/counter_body.hpp>

namespace gnomon {

/// A point X of the body's frame is at x = turn X + shift.
template <int dim>
struct BodyPlace {
  Tensor<dim> turn = Tensor<dim>::Identity();  ///< a rotation
  Vector<dim> shift = Vector<dim>::Zero();     ///< [length]
  RigidMotion<dim> motion{};                   ///< of its material, at points x [length / time]

  Vector<dim> of(const Vector<dim>& X) const { return turn * X + shift; }
};

/// Of the second body's points relative to the first's.
template <int dim>
RigidMotion<dim> relative_motion(const RigidMotion<dim>& first, const RigidMotion<dim>& second) {
  RigidMotion<dim> motion;
  motion.velocity = second.velocity - first.velocity;
  motion.spin = second.spin - first.spin;
  motion.across = second.across - first.across;
  motion.across_by_x = second.across_by_x - first.across_by_x;
  return motion;
}

}  // namespace gnomon
