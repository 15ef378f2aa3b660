// The traction of a slave node of a pair, what its wear reads, and, where friction may stick, the
// rows of its tangential multiplier (docs/two_bodies.md, docs/fretting.md).
#pragma once

#include <gnomon/terms/mortar_node.hpp>
#include <optional>

namespace gnomon {

/// As functions of the node's own unknowns, of its normal n and its position x in space.
template <int dim>
struct MortarTraction {
  using Row = Eigen::RowVectorXd;
  using OfVector = Eigen::Matrix<double, 1, dim>;
  Vector<dim> value = Vector<dim>::Zero();  ///< on the slave, in space [stress]
  Eigen::Matrix<double, dim, Eigen::Dynamic> by_own;
  Tensor<dim> by_n = Tensor<dim>::Zero(), by_x = Tensor<dim>::Zero();
  double pressure = 0, speed = 0;  ///< p and v of the wear law
  Row pressure_by_own, speed_by_own;
  OfVector speed_by_n = OfVector::Zero(), speed_by_x = OfVector::Zero();

  /// Of no traction, with so many unknowns.
  explicit MortarTraction(int unknowns)
      : by_own(dim, unknowns), pressure_by_own(unknowns), speed_by_own(unknowns) {
    by_own.setZero();
    pressure_by_own.setZero();
    speed_by_own.setZero();
  }
  /// In gross sliding: lambda tau; its unknown is lambda.
  MortarTraction(const SlidingTraction<dim>& sliding, double lambda);
};

/// A slave node in a phase of a path, of the pair's two bodies.
template <int dim>
struct StickingInput {
  double lambda = 0;                ///< [stress]
  Vector<dim> traction;             ///< lambda_T, in the frame of the slave [stress]
  Vector<dim> place;                ///< r, in the frame of the master [length]
  double lambda_before = 0;         ///< of the phase before [stress]
  Vector<dim> before;               ///< r of the phase before [length]
  Vector<dim> normal;               ///< n, out of the slave, in space
  std::array<Tensor<dim>, 2> turn;  ///< of slave and master
  /// A direction, unit, of which slip has no part: with small strains slopes are left out.
  Vector<dim> dropped = Vector<dim>::Zero();
};

/// Of one pair.
struct StickingParameters {
  double friction = 0;           ///< Coulomb's coefficient
  double friction_by_depth = 0;  ///< of the slave node [1 / length]
  double rho = 1;                ///< of lambda_T [stress / length]
  double interval = 1;           ///< since the place before [time]
  bool rubs = true;              ///< else it has no friction: where it comes from is not known
};

/// The traction is lambda n_p + lambda_T, n_p = -n, where the slip since the phase before is
/// P (r - r_before), P = 1 - n n' (laws/stick_friction.hpp). Own unknowns: lambda | lambda_T | r |
/// lambda before | r before.
template <int dim>
struct StickingTraction {
  static constexpr int own = 2 + 3 * dim;
  MortarTraction<dim> traction{own};
  Vector<dim> constraint;  ///< C of lambda_T, in the frame of the slave [length]
  Eigen::Matrix<double, dim, own> constraint_by_own;
  Tensor<dim> constraint_by_n;
  Vector<dim> constraint_by_depth;
  Vector<dim> slip;     ///< in the frame of the slave [length]
  double friction = 0;  ///< its coefficient
  bool sticks = false;
  double excess = 0;  ///< |T^| - r, of the switching function [stress]

  StickingTraction(const StickingParameters& parameters, const StickingInput<dim>& at, bool closed,
                   std::optional<bool> sticks);
};

}  // namespace gnomon
