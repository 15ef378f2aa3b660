// The rigid counter-body: its shape, its position, and the motion of its surface.
#pragma once

#include <cmath>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/shapes/counter_shape.hpp>
#include <optional>

namespace gnomon {

/// Velocity of a rigid body's points, v(x) = velocity + spin x. In 2D it may have a component out
/// of the plane, across(x) = across + across_by_x . x: a body that slides along the third
/// direction, or (dim = 2, coordinates r, z) that turns about r = 0.
template <int dim>
struct RigidMotion {
  Vector<dim> velocity = Vector<dim>::Zero();     ///< at the origin of x [length / time]
  Tensor<dim> spin = Tensor<dim>::Zero();         ///< dv/dx, skew [1 / time]
  double across = 0;                              ///< at the origin of x; 2D only [length / time]
  Vector<dim> across_by_x = Vector<dim>::Zero();  ///< 2D only [1 / time]
  Vector<dim> reference = Vector<dim>::Zero();    ///< where the nominal speed of a run is taken
  /// Of the touching surfaces there, unit: what moves along it does not slide. Zero: not known.
  Vector<dim> normal = Vector<dim>::Zero();

  template <class Scalar = double>
  Vector<dim, Scalar> at(const Vector<dim, Scalar>& x) const {
    return velocity.template cast<Scalar>() + spin.template cast<Scalar>() * x;
  }
  template <class Scalar = double>
  Scalar across_at(const Vector<dim, Scalar>& x) const {
    return Scalar(across) + across_by_x.template cast<Scalar>().dot(x);
  }
  /// The velocity at which it slides at `reference` along a body that streams by with `streaming`;
  /// the component out of the plane last.
  Eigen::Matrix<double, dim + 1, 1> sliding_velocity(const Vector<dim>& streaming) const {
    const Vector<dim> relative = at<double>(reference) - streaming;
    Eigen::Matrix<double, dim + 1, 1> v;
    v << relative - normal * normal.dot(relative), across_at<double>(reference);
    return v;
  }
  /// Its magnitude.
  double nominal_speed(const Vector<dim>& streaming) const {
    return sliding_velocity(streaming).norm();
  }
};

/// v(x) = velocity + spin (x - centre)
template <int dim>
RigidMotion<dim> rigid_motion(const Vector<dim>& velocity, const Tensor<dim>& spin,
                              const Vector<dim>& centre) {
  RigidMotion<dim> motion;
  motion.velocity = velocity - spin * centre;
  motion.spin = spin;
  return motion;
}

/// The spin of a rotation in the plane, from its first to its second direction [1 / time].
Tensor<2> spin_in_plane(double rate);
/// The spin of a rotation about a direction of any length, by the right-hand rule [1 / time].
Tensor<3> spin_about(const Vector<3>& axis, double rate);

/// A shape that turns, with a constant spin about a point at rest: a cam. In a phase of a cycle it
/// has turned and stays.
template <int dim>
struct Turning {
  Tensor<dim> spin;    ///< skew [1 / time]
  Vector<dim> centre;  ///< in the coordinates of the shape
  double rate = 1;     ///< 0: it stays
  double start = 0;    ///< how long it has turned at t = 0 [time]

  /// The rotation from the place of the shape, exp((start + rate t) spin).
  Tensor<dim> rotation(double t) const;
};

/// A rigid body that the worn body may not enter. It moves by w along `approach`.
template <int dim>
struct CounterBody {
  CounterShape<dim> shape = plane<dim>(Vector<dim>::Zero(), Vector<dim>::Unit(dim - 1));
  Vector<dim> position = Vector<dim>::Zero();         ///< of the shape's origin at w = 0 [length]
  Vector<dim> approach = Vector<dim>::Unit(dim - 1);  ///< unit
  RigidMotion<dim> motion;  ///< of its surface, v^2 of eq. (6), in the coordinates of the shape
  /// A shape that does not look the same while it turns with `motion`; else the surface moves along
  /// itself, and the shape stays.
  std::optional<Turning<dim>> turning;
  /// A given part of w over time [length], beside the unknown one, if there is one.
  std::optional<LoadHistory> travel;

  /// A point of the worn body in the coordinates of the shape at t = 0 [length].
  template <class Scalar = double>
  Vector<dim, Scalar> seen(const Vector<dim, Scalar>& x, const Scalar& w) const {
    return x - position.template cast<Scalar>() - approach.template cast<Scalar>() * w;
  }
  /// The signed distance of a point as `seen` at the time t. Throws RecoverableError.
  SignedDistance<dim> distance(const Vector<dim>& seen, double t) const;
  /// The same without exceptions: not finite or not unique where `distance` throws.
  SignedDistance<dim> unchecked_distance(const Vector<dim>& seen, double t) const;
  /// The w at which it touches x at t = 0 when it comes from afar [length]; infinite where it
  /// passes by.
  double travel_to(const Vector<dim>& x) const;
};

}  // namespace gnomon
