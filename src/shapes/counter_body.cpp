#include <cmath>
#include <gnomon/shapes/counter_body.hpp>

namespace gnomon {

Tensor<2> spin_in_plane(double rate) {
  return Tensor<2>{{0, -rate}, {rate, 0}};
}

Tensor<3> spin_about(const Vector<3>& axis, double rate) {
  const Vector<3> a = rate * axis.normalized();
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// By Rodrigues' formula: with a = |spin| / sqrt 2, W = spin / a and the angle phi = a (start +
/// rate t), 1 + sin(phi) W + (1 - cos(phi)) W^2.
template <int dim>
Tensor<dim> Turning<dim>::rotation(double t) const {
  const double a = spin.norm() / std::sqrt(2.0);
  if (a == 0) return Tensor<dim>::Identity();
  const Tensor<dim> W = spin / a;
  const double angle = a * (start + rate * t), half = std::sin(angle / 2);
  return Tensor<dim>::Identity() + std::sin(angle) * W + 2 * half * half * W * W;
}

namespace {

/// The signed distance of a shape that has turned, by that of the shape at rest.
template <int dim, class Rest>
SignedDistance<dim> turned(const std::optional<Turning<dim>>& turning, const Vector<dim>& seen,
                           double t, const Rest& at_rest) {
  if (!turning) return at_rest(seen);
  const Tensor<dim> R = turning->rotation(t);
  SignedDistance<dim> at =
      at_rest(Vector<dim>(turning->centre + R.transpose() * (seen - turning->centre)));
  at.normal = R * at.normal;
  at.normal_by_x = R * at.normal_by_x * R.transpose();
  return at;
}

}  // namespace

template <int dim>
SignedDistance<dim> CounterBody<dim>::distance(const Vector<dim>& seen, double t) const {
  return turned(turning, seen, t, [this](const Vector<dim>& x) { return shape.at(x); });
}

template <int dim>
SignedDistance<dim> CounterBody<dim>::unchecked_distance(const Vector<dim>& seen, double t) const {
  return turned(turning, seen, t, [this](const Vector<dim>& x) { return shape.unchecked(x); });
}

template <int dim>
double CounterBody<dim>::travel_to(const Vector<dim>& x) const {
  const Vector<dim> at = x - position;
  if (!turning) return shape.travel_to(at, approach);
  const Tensor<dim> back = turning->rotation(0).transpose();
  return shape.travel_to(turning->centre + back * (at - turning->centre), back * approach);
}

template struct Turning<2>;
template struct Turning<3>;
template struct CounterBody<2>;
template struct CounterBody<3>;

}  // namespace gnomon
