// The coefficients of a Runge-Kutta method, explicit or diagonally implicit.
#pragma once

#include <Eigen/Core>
#include <string>

namespace gnomon {

/// k_i = f(t + c_i h, y + h sum_j A_ij k_j),  y_new = y + h sum_i b_i k_i. A is lower triangular.
struct ButcherTable {
  std::string name;            ///< source of the coefficients
  int order = 0;               ///< p
  Eigen::MatrixXd A;           ///< stages x stages
  Eigen::VectorXd b, c;        ///< stages
  int embedded_order = 0;      ///< 0 without an embedded method
  Eigen::VectorXd b_embedded;  ///< stages; empty without one

  int stages() const { return static_cast<int>(b.size()); }
  /// The last stage is the new value.
  bool stiffly_accurate() const { return A.row(stages() - 1).transpose().isApprox(b, 1e-14); }
  /// The first stage is the old value.
  bool explicit_first_stage() const { return A(0, 0) == 0; }
};

/// The diagonally implicit table that ARKODE calls `name` ("ARKODE_ESDIRK436L2SA_6_3_4"). Throws
/// Error when the installed SUNDIALS has none.
ButcherTable arkode_dirk_table(const std::string& name);

/// The explicit table that ARKODE calls `name` ("ARKODE_BOGACKI_SHAMPINE_4_2_3"). Same errors.
ButcherTable arkode_erk_table(const std::string& name);

}  // namespace gnomon
