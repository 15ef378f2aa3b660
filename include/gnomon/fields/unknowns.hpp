// Numbering of the unknowns: which nodal value is which entry of y. Fixed values have no number.
#pragma once

#include <gnomon/terms/worn_body.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Which blocks a system solves for; the others are frozen.
struct Selection {
  bool deformation = true;     ///< u, lambda and w
  bool interior_shape = true;  ///< d off the contact surface, and mu where the form has it
  bool contact_shape = true;   ///< d on the contact surface: the differential unknowns
};

/// All nodal values of a state, fixed and frozen ones included.
template <int dim>
struct NodalState {
  NodalField<dim> u;       ///< displacement, nodes x dim
  NodalField<dim> d;       ///< shape, nodes x dim
  Eigen::VectorXd lambda;  ///< contact multiplier, one a contact node
  NodalField<dim> mu;      ///< shape multiplier, contact nodes x dim
  double w = 0;            ///< rigid motion of the counter-body [length]

  static NodalState zero(const WornBody<dim>& body);
};

/// Numbers are -1 where a value is fixed, frozen or absent. Node by node: u, d, lambda, mu; then w.
/// With a cross-section, nodes share the numbers of their shape.
template <int dim>
class Unknowns {
public:
  using Numbers = Eigen::Matrix<int, Eigen::Dynamic, dim, Eigen::RowMajor>;

  Unknowns(const WornBody<dim>& body, const Selection& selection);

  int size() const { return size_; }
  const Numbers& u() const { return u_; }                    ///< nodes x dim
  const Numbers& d() const { return d_; }                    ///< nodes x dim
  const Eigen::VectorXi& lambda() const { return lambda_; }  ///< contact nodes
  const Numbers& mu() const { return mu_; }                  ///< contact nodes x dim
  int w() const { return w_; }
  /// Row of the auxiliary equilibrium of each shape value: its own number off the contact surface,
  /// that of mu on it (so that both rows there have a nonzero diagonal), else -1. nodes x dim.
  const Numbers& auxiliary_row() const { return auxiliary_row_; }
  /// The mesh node that each unknown belongs to; w has a group of its own behind the nodes.
  const std::vector<int>& node() const { return node_; }

  /// Copies y into the nodal state, other values untouched.
  void scatter(std::span<const double> y, NodalState<dim>& state) const;
  /// Copies the nodal state into y.
  void gather(const NodalState<dim>& state, std::span<double> y) const;

private:
  int size_ = 0, w_ = -1;
  Numbers u_, d_, mu_, auxiliary_row_;
  Eigen::VectorXi lambda_;
  std::vector<int> node_;
};

}  // namespace gnomon
