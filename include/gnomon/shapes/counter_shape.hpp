// Shapes of rigid counter-bodies as signed distances. How scenes name them: counter_shape_kind.hpp.
#pragma once

#include <functional>
#include <gnomon/base/tensor.hpp>
#include <utility>

namespace gnomon {

/// The signed distance of a point from a surface, with its derivatives.
template <int dim>
struct SignedDistance {
  double gap;               ///< g of eq. (5), positive outside [length]
  Vector<dim> normal;       ///< n = dg/dx: unit, out of the counter-body
  Tensor<dim> normal_by_x;  ///< H = dn/dx: symmetric, H n = 0 [1 / length]
  /// Whether one point of the surface alone is nearest. If not, the gap holds and the normal is one
  /// of several: on the axis of a conical seat, half-way between the flanks of a groove.
  bool unique = true;
};

/// A rigid body by the signed distance of points from its surface, in coordinates in which it
/// rests. A value; copies share what they hold.
template <int dim>
class CounterShape {
public:
  using Function = std::function<SignedDistance<dim>(const Vector<dim>& x)>;

  /// `reach` [length]: further than this from the origin its surface is straight (a plane, an
  /// infinite cylinder) or not there (a ball).
  /// Throws RegistrationError without a distance.
  CounterShape(Function distance, double reach);

  /// Throws RecoverableError where there is no distance, and where x is inside and has no normal
  /// (in the centre of a ball) or several.
  SignedDistance<dim> at(const Vector<dim>& x) const;
  /// The same, not finite or not unique where `at` throws: for shapes made of this one.
  SignedDistance<dim> unchecked(const Vector<dim>& x) const { return distance_(x); }

  /// The w at which the shape, moved by w along the unit vector `approach`, touches x when it comes
  /// from afar [length]; infinite where it passes by. Where nothing can come from afar, because the
  /// shape surrounds a cavity, it comes from where x has the most room in the cavity nearest to it.
  double travel_to(const Vector<dim>& x, const Vector<dim>& approach) const;

  double reach() const { return reach_; }

private:
  /// A w on the ray of x from which to approach; infinite where nothing of the ray is outside.
  double start(const Vector<dim>& x, const Vector<dim>& approach) const;

  Function distance_;
  double reach_;
};

/// Calls `visit` with points of the surface, spread over its reach and around `centre`, and their
/// normals.
template <int dim>
void visit_surface(const CounterShape<dim>& shape, const Vector<dim>& centre,
                   const std::function<void(const Vector<dim>& x, const Vector<dim>& n)>& visit);

/// Whether the shape looks the same while it turns with the skew `spin` about `centre`: its surface
/// then moves along itself. By points of the surface.
template <int dim>
bool turns_into_itself(const CounterShape<dim>& shape, const Tensor<dim>& spin,
                       const Vector<dim>& centre);

// ---- shapes ----

/// A half-space (2D: half-plane) through `point`, with the outward normal of any length.
template <int dim>
CounterShape<dim> plane(const Vector<dim>& point, const Vector<dim>& normal);

/// A ball. In 2D a disk: a cylinder seen along its axis.
template <int dim>
CounterShape<dim> ball(const Vector<dim>& centre, double radius);

/// An infinite circular cylinder by a point of its axis, and the axis' direction of any length.
CounterShape<3> cylinder(const Vector<3>& point, const Vector<3>& axis, double radius);

/// A cone that widens from `apex` along `axis`, of any length, without end. In 2D a wedge, its
/// section. `half_angle`: between axis and surface, in (0, pi/2) [rad].
template <int dim>
CounterShape<dim> cone(const Vector<dim>& apex, const Vector<dim>& axis, double half_angle);

/// The flank of a cone about the axis x_1 = 0 in the half-plane (r, z), x_1 = r >= 0, with the apex
/// at z = `apex`; it widens towards `direction` = 1 or -1. On the axis the closest point is unique.
CounterShape<2> cone_meridian(double apex, double direction, double half_angle);

/// A ring of circular section: points at the distance `minor` < `major` from a circle about `axis`,
/// of any length.
CounterShape<3> torus(const Vector<3>& centre, const Vector<3>& axis, double major, double minor);

// ---- shapes made of shapes ----

/// All that is outside of `shape`: a socket of a ball, a bore of a cylinder, a seat of a cone.
template <int dim>
CounterShape<dim> complement(const CounterShape<dim>& shape);

/// The body of revolution about `axis` (of any length) through `origin`, by its meridian in the
/// half-plane (r, z), r >= 0, with z along the axis from `origin`. On the axis the closest point is
/// unique where the meridian's normal has no part along r.
CounterShape<3> revolved(const CounterShape<2>& meridian, const Vector<3>& origin,
                         const Vector<3>& axis);

/// The body that does not change along the third of the orthonormal directions `frame` (columns),
/// by its section in the first two, seen from `origin`.
CounterShape<3> extruded(const CounterShape<2>& section, const Vector<3>& origin,
                         const Tensor<3>& frame);

}  // namespace gnomon
