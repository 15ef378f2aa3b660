// Pointwise laws of contact and wear: pure functions of one contact node.
#pragma once

#include <cmath>
#include <gnomon/base/tensor.hpp>
#include <limits>

namespace gnomon {

/// Which branch of a complementarity condition is meant.
enum class Branch { by_sign, closed, open };

/// Augmented-Lagrangian treatment of unilateral contact, eq. (26), with its derivatives.
/// lambda <= 0 is the nominal normal traction [stress], g the normal gap [length], rho > 0 the
/// regularization [stress / length]. A branch that is given instead of chosen by the sign is
/// continued smoothly beyond its border.
template <class Scalar = double>
struct UnilateralContact {
  bool active;        ///< lambda + rho g <= 0, or as given
  Scalar traction;    ///< effective multiplier lambda_eff [stress]
  Scalar constraint;  ///< C_N [length]
  double traction_by_lambda, traction_by_gap;
  double constraint_by_lambda, constraint_by_gap;

  UnilateralContact(const Scalar& lambda, const Scalar& g, double rho,
                    Branch branch = Branch::by_sign) {
    const Scalar augmented = lambda + rho * g;
    active = branch == Branch::by_sign ? augmented <= Scalar(0) : branch == Branch::closed;
    traction = active ? augmented : Scalar(0);
    constraint = active ? g : Scalar(-lambda / rho);
    traction_by_lambda = active ? 1 : 0;
    traction_by_gap = active ? rho : 0;
    constraint_by_lambda = active ? 0 : -1 / rho;
    constraint_by_gap = active ? 1 : 0;
  }
};

/// Archard wear, Wdot = c |T_N| |v_T| [length / time], with the sliding velocity v_T. The
/// coefficient c [1 / stress] is k where there is no friction (sec. 4.1), and K times the friction
/// coefficient where wear follows the frictional dissipation (eq. 13).
struct ArchardWear {
  double coefficient = 0;

  template <class Scalar>
  Scalar rate(const Scalar& traction, const Scalar& speed) const {
    return Scalar(-coefficient * traction * speed);
  }
};

/// A rigid body that the worn body may not enter: a half-space, or a ball where `radius` is given.
/// It moves by w along `approach`, so that a point x of the worn body lies at x - w approach as
/// seen from it.
template <int dim>
struct CounterBody {
  Vector<dim> point = Vector<dim>::Zero();  ///< on the plane, or the centre of the ball [length]
  Vector<dim> normal = Vector<dim>::Unit(dim - 1);    ///< of the plane: unit, out of the half-space
  double radius = 0;                                  ///< of the ball [length]; 0: a half-space
  Vector<dim> approach = Vector<dim>::Unit(dim - 1);  ///< unit
  Vector<dim> velocity = Vector<dim>::Zero();         ///< v^2 [length / time]

  /// Normal gap g of eq. (5) [length] and the unit normal n out of the counter-body.
  template <class Scalar>
  struct Projection {
    Scalar gap;
    Vector<dim, Scalar> normal;
  };
  template <class Scalar>
  Projection<Scalar> project(const Vector<dim, Scalar>& x) const {
    const Vector<dim, Scalar> from = x - point.template cast<Scalar>();
    if (radius == 0)
      return {Scalar(normal.template cast<Scalar>().dot(from)), normal.template cast<Scalar>()};
    const Scalar distance = from.norm();
    return {Scalar(distance - radius), from / distance};
  }
  /// The w at which it touches x when it comes from afar [length]; infinite where it passes by.
  double travel_to(const Vector<dim>& x) const {
    const Vector<dim> from = x - point;
    if (radius == 0) return normal.dot(from) / normal.dot(approach);
    const double along = approach.dot(from);
    const double across = from.squaredNorm() - along * along;
    return across < radius * radius ? along - std::sqrt(radius * radius - across)
                                    : std::numeric_limits<double>::infinity();
  }
  /// dn/dx [1 / length].
  Tensor<dim> normal_by_x(const Vector<dim>& x) const {
    if (radius == 0) return Tensor<dim>::Zero();
    const Vector<dim> from = x - point;
    const double distance = from.norm();
    const Vector<dim> n = from / distance;
    return (Tensor<dim>::Identity() - n * n.transpose()) / distance;
  }
};

}  // namespace gnomon
