// The rigid counter-body: its shape, its position, and the motion of its surface.
#pragma once

#include <gnomon/laws/counter_shape.hpp>

namespace gnomon {

/// Velocity of a rigid body's points, v(x) = velocity + spin x.
template <int dim>
struct RigidMotion {
  Vector<dim> velocity = Vector<dim>::Zero();  ///< at the origin of x [length / time]
  Tensor<dim> spin = Tensor<dim>::Zero();      ///< dv/dx, skew [1 / time]

  template <class Scalar = double>
  Vector<dim, Scalar> at(const Vector<dim, Scalar>& x) const {
    return velocity.template cast<Scalar>() + spin.template cast<Scalar>() * x;
  }
};

/// A rigid body that the worn body may not enter. It moves by w along `approach`.
template <int dim>
struct CounterBody {
  CounterShape<dim> shape = plane<dim>(Vector<dim>::Zero(), Vector<dim>::Unit(dim - 1));
  Vector<dim> position = Vector<dim>::Zero();         ///< of the shape's origin at w = 0 [length]
  Vector<dim> approach = Vector<dim>::Unit(dim - 1);  ///< unit
  RigidMotion<dim> motion;  ///< of its surface, v^2 of eq. (6), in the coordinates of the shape

  /// A point of the worn body in the coordinates of the shape [length].
  template <class Scalar = double>
  Vector<dim, Scalar> seen(const Vector<dim, Scalar>& x, const Scalar& w) const {
    return x - position.template cast<Scalar>() - approach.template cast<Scalar>() * w;
  }
  /// The w at which it first touches x, coming from far away [length]; infinite if it does not
  /// touch x.
  double travel_to(const Vector<dim>& x) const { return shape.travel_to(x - position, approach); }
};

}  // namespace gnomon
