// The inverse of a stiffness some of whose springs have changed since it was factorized.
#pragma once

#include <Eigen/LU>
#include <array>
#include <gnomon/linear/inner_solver.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// A spring along the unit vector v of one node, in the numbers of the stiffness.
struct SpringDirection {
  std::array<int, 3> unknown{};
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< zero where an entry of `unknown` is unused
};

/// Of K + V diag(k) V^T by the formula of Sherman, Morrison and Woodbury, with Y = K^-1 V:
///
///   x = x0 - Y (1 + diag(k) V^T Y)^-1 diag(k) V^T x0,   x0 = K^-1 b
///
/// A column costs a solve with K once, less than that many at a time; a set-up costs some hundred
/// solves in three dimensions.
class SpringUpdate {
public:
  /// Forgets all columns: K is new, with all springs as they are.
  void clear();
  /// Appends columns, which are solved for by `stiffness` of `size` unknowns.
  void append(std::span<const SpringDirection> springs, InnerSolver& stiffness, long size);
  /// Takes k of every column, as appended [force/length].
  void change(const Eigen::VectorXd& k);
  /// x0 becomes x.
  void correct(std::span<double> x) const;
  long columns() const { return static_cast<long>(springs_.size()); }

private:
  double along(std::size_t spring, const double* x) const;

  std::vector<SpringDirection> springs_;
  Eigen::MatrixXd Y_;
  Eigen::VectorXd k_;
  Eigen::PartialPivLU<Eigen::MatrixXd> inverse_;
};

}  // namespace gnomon
