// Unilateral contact of one node: eq. (9) and (26).
#pragma once

namespace gnomon {

/// The branch of a complementarity condition.
enum class Branch { by_sign, closed, open };

/// Augmented-Lagrangian treatment of unilateral contact, eq. (26), with its derivatives.
/// lambda <= 0 is the nominal normal traction [stress], g the normal gap [length], rho > 0 the
/// regularization [stress / length]. A prescribed branch, which is not chosen by the sign, is
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

}  // namespace gnomon
