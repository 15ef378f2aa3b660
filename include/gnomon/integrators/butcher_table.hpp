// The coefficients of a Runge-Kutta method, explicit or diagonally implicit.
#pragma once

#include <Eigen/Core>
#include <string>

namespace gnomon {

/// k_i = f(t + c_i h, y + h sum_j A_ij k_j),  y_new = y + h sum_i b_i k_i. A is lower triangular.
struct ButcherTable {
  std::string name;              ///< source of the coefficients
  int order = 0;                 ///< p
  Eigen::MatrixXd A;             ///< stages x stages
  Eigen::VectorXd b, c;          ///< stages
  int embedded_order = 0;        ///< 0 without an embedded method
  Eigen::VectorXd b_embedded{};  ///< stages; empty without one

  int stages() const { return static_cast<int>(b.size()); }
  /// The last stage is the new value.
  bool stiffly_accurate() const { return A.row(stages() - 1).transpose().isApprox(b, 1e-14); }
  /// The first stage is the old value.
  bool explicit_first_stage() const { return A(0, 0) == 0; }
};

/// Whether every stage depends on the ones before it alone.
inline bool is_explicit(const ButcherTable& table) {
  return table.A.triangularView<Eigen::Upper>().toDenseMatrix().isZero(0);
}

/// The table itself. Throws RegistrationError where it is not that of such a method: sizes, finite
/// values, A lower triangular, c = A 1, the conditions of its orders, of which those beyond four
/// are not checked.
ButcherTable checked_table(ButcherTable table);

}  // namespace gnomon
