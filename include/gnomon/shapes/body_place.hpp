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

/// Adds a motion of points y = x - origin, times a factor, to one of points x.
template <int dim>
void add_motion(double factor, const RigidMotion<dim>& motion, const Vector<dim>& origin,
                RigidMotion<dim>& sum) {
  const Vector<dim> y = -origin;  // of x = 0
  sum.velocity += factor * motion.at(y);
  sum.spin += factor * motion.spin;
  sum.across += factor * motion.across_at(y);
  sum.across_by_x += factor * motion.across_by_x;
}

/// Of the second body's points relative to the first's.
template <int dim>
RigidMotion<dim> relative_motion(const RigidMotion<dim>& first, const RigidMotion<dim>& second) {
  RigidMotion<dim> motion;
  add_motion<dim>(1, second, Vector<dim>::Zero(), motion);
  add_motion<dim>(-1, first, Vector<dim>::Zero(), motion);
  return motion;
}

}  // namespace gnomon
