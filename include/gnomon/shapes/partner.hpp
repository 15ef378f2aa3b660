// What a contact node meets, whoever it is: a rigid body, or later another surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <gnomon/base/tensor.hpp>

namespace gnomon {

/// Upper bound of the unknowns of its partner that a contact node meets: three translations and
/// three rotations of a rigid body.
inline constexpr int most_partner_unknowns = 6;

/// Values of the partner's unknowns q.
template <class Scalar = double>
using PartnerMotion = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, most_partner_unknowns, 1>;

/// The partner as a node at x meets it. A small motion dq carries the partner's surface there along
/// by G dq: the gap reads x_rel = x - G q, and a force f on the body is -G^T f in the rows of q.
/// Derivatives are by z = (x, q): a column for each direction, then one for each unknown.
template <int dim>
struct Partner {
  static constexpr int most = dim + most_partner_unknowns;
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most>;
  using Columns = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, most>;

  double gap = 0;                              ///< g of eq. (5), positive outside [length]
  Vector<dim> normal = Vector<dim>::Zero();    ///< n: unit, out of the partner
  bool unique = true;                          ///< as SignedDistance::unique
  Vector<dim> velocity = Vector<dim>::Zero();  ///< v^2 of eq. (6), of its surface [length / time]
  double across = 0;                           ///< 2D: the same out of the plane
  Columns weights = {};                        ///< G, a column for each unknown
  Row gap_by = {}, across_by = {};
  Columns normal_by = {}, velocity_by = {};
  /// dG of each unknown; empty where it is constant.
  std::array<Columns, most_partner_unknowns> weights_by = {};

  Eigen::Index unknowns() const { return weights.cols(); }
};

}  // namespace gnomon
