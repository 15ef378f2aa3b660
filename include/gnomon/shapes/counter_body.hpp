// The rigid counter-body: its shape, its position, and the motion of its surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/shapes/counter_shape.hpp>
#include <gnomon/shapes/partner.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

  /// In the plane: within it.
  bool moves() const { return !velocity.isZero(0) || !spin.isZero(0); }
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
  /// Of a whole turn [time].
  double duration() const { return 2 * std::numbers::pi * std::numbers::sqrt2 / spin.norm(); }
  /// A sixteenth of a turn: longer ones see the shape at a few angles only, and may step over all
  /// that it touches [time].
  double longest_step() const { return duration() / 16; }
};

/// A way in which a rigid body moves as a whole: along a direction, or about an axis. It is given,
/// or free under a force; else the body is held there.
template <int dim>
struct Guide {
  Vector<dim> along = Vector<dim>::Zero();   ///< unit; zero: it turns
  Tensor<dim> turn = Tensor<dim>::Zero();    ///< skew, of the rate one
  Vector<dim> centre = Vector<dim>::Zero();  ///< of the turn, in the coordinates of the shape
  std::optional<LoadHistory> travel = {};    ///< given: how far, over time [length]
  /// Free: the force along it, or the moment about it, at factor one [force; force length].
  std::optional<double> force = {};
  LoadHistory factors = {};  ///< of the force over time
  double share = 0;          ///< its part in CounterBody::approach
  /// Beside material that streams past: it does not move the body, but its number is a creepage
  /// along it times this length, or about its axis times the square (docs/rolling.md); 0: none
  /// [length].
  double creep = 0;
  std::string key = {};  ///< the table of a scene that describes it

  bool turns() const { return along.isZero(0) && !creeps(); }
  bool creeps() const { return creep > 0; }
  /// A creepage about an axis.
  bool spins() const { return creeps() && along.isZero(0); }
  /// The creepage that its number q stands for [1; 1 / length].
  double creepage(double q) const { return q / (spins() ? creep * creep : creep); }
  /// Where that is one, how a point slides, in the coordinates of the shape.
  Vector<dim> creeping_at(const Vector<dim>& x) const { return along + turn * (x - centre); }
  /// How far it moves the body by its number q.
  Vector<dim> travelled(double q) const {
    return creeps() ? Vector<dim>(Vector<dim>::Zero()) : Vector<dim>(q * along);
  }
  bool is_held() const { return !travel && !force; }
};

/// A rigid body that the worn body may not enter. Its motion q has one number for each of `guides`:
/// a distance, or the angle of the one that turns.
template <int dim>
struct CounterBody {
  CounterShape<dim> shape = plane<dim>(Vector<dim>::Zero(), Vector<dim>::Unit(dim - 1));
  Vector<dim> position = Vector<dim>::Zero();  ///< of the shape's origin at q = 0 [length]
  /// The direction in which it comes near before a run starts: unit.
  Vector<dim> approach = Vector<dim>::Unit(dim - 1);
  std::vector<Guide<dim>> guides;  ///< at most one turns, and none beside `turning`
  RigidMotion<dim> motion;  ///< of its surface, v^2 of eq. (6), in the coordinates of the shape
  /// A shape that does not look the same while it turns with `motion`; else the surface moves along
  /// itself, and the shape stays.
  std::optional<Turning<dim>> turning;

  /// It moves along `approach` alone, as far as `travel` says or freely.
  void guide(const std::optional<LoadHistory>& travel = {}) {
    guides = {{.along = approach, .travel = travel, .share = 1}};
  }
  bool is_given() const {
    return std::ranges::any_of(guides, [](const auto& guide) { return guide.travel.has_value(); });
  }
  /// It comes near along the part of `direction`, of any length, in which its free guides, or
  /// without any the given ones, can move it; nothing changes where that is none.
  void come_along(const Vector<dim>& direction);
  /// The given part of q.
  PartnerMotion<> given(double t, double within) const;
  /// q before the start, when it has come w along `approach`.
  PartnerMotion<> brought(double w) const;

  /// A point of the worn body in the coordinates of the shape, when the counter-body has come w
  /// along `approach` [length].
  Vector<dim> seen(const Vector<dim>& x, double w) const { return x - position - approach * w; }
  /// The same for a motion q.
  Vector<dim> seen(const Vector<dim>& x, const PartnerMotion<>& q) const;
  /// The signed distance of a point as `seen` at the time t, not finite or not unique where it has
  /// none.
  SignedDistance<dim> unchecked_distance(const Vector<dim>& seen, double t) const;
  /// The same for a motion q.
  SignedDistance<dim> unchecked_distance(const Vector<dim>& x, const PartnerMotion<>& q,
                                         double t) const;
  /// What a node at x meets. Throws RecoverableError where there is no distance.
  Partner<dim> meet(const Vector<dim>& x, const PartnerMotion<>& q, double t) const;
  /// The w at which it touches x at t = 0 when it comes from afar [length]; infinite where it
  /// passes by.
  double travel_to(const Vector<dim>& x) const;
  /// The same for a surface with the outward normal `outward`; infinite where it faces the same way
  /// as `approach`, so that it is not what comes near that touches it.
  double travel_to(const Vector<dim>& x, const Vector<dim>& outward) const {
    return outward.dot(approach) < 0 ? travel_to(x) : std::numeric_limits<double>::infinity();
  }

private:
  std::optional<std::pair<Tensor<dim>, Vector<dim>>> place(const PartnerMotion<>& q,
                                                           double t) const;
};

}  // namespace gnomon
