#include <cmath>
#include <gnomon/laws/counter_body.hpp>

namespace gnomon {

Tensor<2> spin_in_plane(double rate) {
  return Tensor<2>{{0, -rate}, {rate, 0}};
}

Tensor<3> spin_about(const Vector<3>& axis, double rate) {
  const Vector<3> a = rate * axis.normalized();
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// By Rodrigues' formula: with the rate a = |spin| / sqrt 2 and W = spin / a,
/// 1 + sin(a t) W + (1 - cos(a t)) W^2.
template <int dim>
Tensor<dim> Turning<dim>::rotation(double t) const {
  const double rate = spin.norm() / std::sqrt(2.0);
  if (rate == 0) return Tensor<dim>::Identity();
  const Tensor<dim> W = spin / rate;
  const double half = std::sin(rate * t / 2);
  return Tensor<dim>::Identity() + std::sin(rate * t) * W + 2 * half * half * W * W;
}

template <int dim>
SignedDistance<dim> CounterBody<dim>::distance(const Vector<dim>& seen, double t) const {
  if (!turning) return shape.at(seen);
  const Tensor<dim> R = turning->rotation(t);
  SignedDistance<dim> at = shape.at(turning->centre + R.transpose() * (seen - turning->centre));
  at.normal = R * at.normal;
  at.normal_by_x = R * at.normal_by_x * R.transpose();
  return at;
}

template struct Turning<2>;
template struct Turning<3>;
template struct CounterBody<2>;
template struct CounterBody<3>;

}  // namespace gnomon
