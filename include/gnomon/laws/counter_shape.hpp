// Shapes of rigid counter-bodies as signed distances. How scenes name them: catalogue.hpp.
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
};

/// A rigid body by the signed distance of points from its surface, in coordinates in which it
/// rests. A value; copies share what they hold.
template <int dim>
class CounterShape {
public:
  using Function = std::function<SignedDistance<dim>(const Vector<dim>& x)>;

  /// `reach` [length]: further than this from the origin its surface is straight (a plane, an
  /// infinite cylinder) or not there (a ball).
  CounterShape(Function distance, double reach) : distance_(std::move(distance)), reach_(reach) {}

  /// Throws RecoverableError where there is no distance, or no normal: in the centre of a ball.
  SignedDistance<dim> at(const Vector<dim>& x) const;

  /// The w at which the shape, moved by w along the unit vector `approach`, touches x when it comes
  /// from afar [length]; infinite where it passes by.
  double travel_to(const Vector<dim>& x, const Vector<dim>& approach) const;

private:
  Function distance_;
  double reach_;
};

/// A half-space (2D: half-plane) through `point`, with the outward normal of any length.
template <int dim>
CounterShape<dim> plane(const Vector<dim>& point, const Vector<dim>& normal);

/// A ball. In 2D a disk: a cylinder seen along its axis.
template <int dim>
CounterShape<dim> ball(const Vector<dim>& centre, double radius);

/// An infinite circular cylinder by a point of its axis, and the axis' direction of any length.
CounterShape<3> cylinder(const Vector<3>& point, const Vector<3>& axis, double radius);

}  // namespace gnomon
