// The inverse of a stiffness that has changed by a few columns since it was factorized.
#pragma once

#include <Eigen/LU>
#include <gnomon/linear/inner_solver.hpp>
#include <map>
#include <span>
#include <vector>

namespace gnomon {

struct SparseVector {
  std::vector<int> index;
  std::vector<double> value;

  double dot(const double* x) const;
};

/// k u v^T, to be added to a matrix. `id` identifies the term.
struct RankOneTerm {
  int id = 0;
  double k = 0;
  SparseVector u, v;
};

/// Solves with K + U diag(k) V^T by the formula of Sherman, Morrison and Woodbury, with Y = K^-1 U:
///
///   x = x0 - Y (1 + diag(k) V^T Y)^-1 diag(k) V^T x0,   x0 = K^-1 b
///
/// A column of Y costs less than one solve with K; a new factorization costs some dozens of solves.
class LowRankUpdate {
public:
  /// Discards everything, because K is new.
  void clear();
  /// How many columns set() would have to solve for: those of new terms, and those whose u has
  /// changed direction too much for the old column.
  long columns_to_solve(const std::vector<RankOneTerm>& terms) const;
  /// Takes all terms of the change, and solves for their columns with `stiffness` of `size`
  /// unknowns where needed.
  void set(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness, long size);
  /// x0 becomes x.
  void correct(std::span<double> x) const;

private:
  struct Column {
    long number;
    SparseVector u;
  };
  bool serves(const RankOneTerm& term) const;
  void solve(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness, long size);

  std::map<int, Column> columns_;  // by id
  std::vector<RankOneTerm> terms_;
  std::vector<long> column_of_;  // the column of each of terms_
  Eigen::MatrixXd Y_;
  Eigen::MatrixXd U_, solved_;  // some columns of U and of Y
  Eigen::PartialPivLU<Eigen::MatrixXd> inverse_;
};

}  // namespace gnomon
