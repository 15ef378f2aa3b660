// Where a rigid partner is in a phase of a path, and the place of a point on it (docs/fretting.md).
#pragma once

#include <cmath>
#include <gnomon/base/tensor.hpp>
#include <gnomon/shapes/counter_body.hpp>

namespace gnomon {

/// How far a rotation about an axis carries v, without the cancellation of a difference.
template <int dim, class Scalar>
Vector<dim, Scalar> carried_by_turn(const Tensor<dim>& spin, double angle,
                                    const Vector<dim, Scalar>& v) {
  const Tensor<dim> by = std::sin(angle) * spin + (1 - std::cos(angle)) * spin * spin;
  return by.template cast<Scalar>() * v;
}

/// Without its unknowns.
template <int dim>
struct PlaceOfPartner {
  Vector<dim> moved = Vector<dim>::Zero();  ///< from where it is at rest [length]
  double angle = 0;                         ///< given [rad]
};

/// The partner moves by `moved` and its free translations, and turns about `centre`, which moves
/// with it, by `angle` or by a small free angle, to first order in that.
template <int dim>
struct PathOfPartner {
  Tensor<dim> spin = Tensor<dim>::Zero();    ///< skew, of the rate one; zero: it does not turn
  Vector<dim> centre = Vector<dim>::Zero();  ///< at rest [length]
  PlaceOfPartner<dim> now{}, before{};       ///< in this phase, and the one before it

  /// r of a material point, which is at X + u: where it is on the partner, less where X is on the
  /// one at rest.
  template <class Scalar>
  Vector<dim, Scalar> place(const PlaceOfPartner<dim>& at, const std::vector<Guide<dim>>& guides,
                            const PartnerMotion<Scalar>& q, const Vector<dim, Scalar>& X,
                            const Vector<dim, Scalar>& u) const {
    Vector<dim, Scalar> moved = at.moved.template cast<Scalar>();
    Scalar free_angle(0);
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const Guide<dim>& guide = guides[static_cast<std::size_t>(k)];
      if (guide.turns()) free_angle += q[k];
      moved += guide.along.template cast<Scalar>() * q[k];
    }
    Vector<dim, Scalar> change = u - moved;
    if (spin.isZero(0)) return change;
    const Vector<dim, Scalar> arm = X - centre.template cast<Scalar>() - moved;
    return change + carried_by_turn<dim, Scalar>(spin, -at.angle, arm + u) -
           spin.template cast<Scalar>() * arm * free_angle;
  }

  /// A change of r in space: midway between both places, and so long that a point at rest slips
  /// by the arc and not by its chord.
  template <class Scalar>
  Vector<dim, Scalar> in_space(const Vector<dim, Scalar>& change) const {
    if (now.angle == 0 && before.angle == 0) return change;
    const double half = (now.angle - before.angle) / 2,
                 stretch = half == 0 ? 1 : half / std::sin(half);
    return (change + carried_by_turn<dim, Scalar>(spin, (now.angle + before.angle) / 2, change)) *
           Scalar(stretch);
  }
};

}  // namespace gnomon
