// The inverse of a stiffness that has changed by a few columns since it was factorized.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gnomon/linear/inner_solver.hpp>
#include <map>
#include <span>
#include <vector>

namespace gnomon {

struct SparseVector {
  std::vector<int> index;
  std::vector<double> value;

  double dot(const double* x) const {
    double sum = 0;
    for (std::size_t k = 0; k < index.size(); ++k) sum += value[k] * x[index[k]];
    return sum;
  }
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
  void clear() {
    columns_.clear();
    terms_.clear();
    column_of_.clear();
    Y_.resize(0, 0);
  }
  /// How many columns set() would have to solve for: those of new terms, and those whose u has
  /// changed direction too much for the old column.
  long columns_to_solve(const std::vector<RankOneTerm>& terms) const {
    return std::count_if(terms.begin(), terms.end(),
                         [this](const RankOneTerm& term) { return !serves(term); });
  }

  /// Takes all terms of the change, and solves for their columns with `stiffness` of `size`
  /// unknowns where needed.
  void set(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness, long size) {
    solve(terms, stiffness, size);
    terms_ = terms;
    column_of_.clear();
    for (const RankOneTerm& term : terms) column_of_.push_back(columns_.at(term.id).number);
    const long count = static_cast<long>(terms.size());
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(count, count);
    for (long j = 0; j < count; ++j)
      for (long i = 0; i < count; ++i)
        M(i, j) += terms[i].k * terms[i].v.dot(Y_.col(column_of_[j]).data());
    if (count > 0) inverse_.compute(M);
  }

  /// x0 becomes x.
  void correct(std::span<double> x) const {
    if (terms_.empty()) return;
    Eigen::VectorXd s(static_cast<long>(terms_.size())), y = Eigen::VectorXd::Zero(Y_.cols());
    for (std::size_t i = 0; i < terms_.size(); ++i) s[i] = terms_[i].k * terms_[i].v.dot(x.data());
    s = inverse_.solve(s);
    for (std::size_t i = 0; i < terms_.size(); ++i) y[column_of_[i]] = s[i];
    Eigen::Map<Eigen::VectorXd>(x.data(), Y_.rows()).noalias() -= Y_ * y;
  }

private:
  /// The largest entry of |a - b| divided by that of |b|; b must not be zero. 1 if their patterns
  /// differ.
  static double turned(const SparseVector& a, const SparseVector& b) {
    if (a.index != b.index) return 1;
    double difference = 0, size = 0;
    for (std::size_t k = 0; k < a.value.size(); ++k) {
      const double here = std::abs(a.value[k] - b.value[k]);
      if (!(here <= difference)) difference = here;  // a NaN counts as a difference
      size = std::max(size, std::abs(b.value[k]));
    }
    return difference / size;
  }
  struct Column {
    long number;
    SparseVector u;
  };
  bool serves(const RankOneTerm& term) const {
    constexpr double tolerance = 0.1;
    const auto found = columns_.find(term.id);
    return found != columns_.end() && turned(found->second.u, term.u) < tolerance;
  }

  void solve(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness, long size) {
    constexpr long most = 64;  // columns per solve
    std::vector<const RankOneTerm*> fresh;
    for (const RankOneTerm& term : terms)
      if (!serves(term)) fresh.push_back(&term);
    if (fresh.empty()) return;
    U_.resize(size, most);
    solved_.resize(size, most);
    for (const RankOneTerm* term : fresh)
      columns_.try_emplace(term->id, Column{long(columns_.size()), {}});
    Y_.conservativeResize(size, static_cast<long>(columns_.size()));
    for (std::size_t start = 0; start < fresh.size(); start += most) {
      const long count = std::min(most, static_cast<long>(fresh.size() - start));
      U_.leftCols(count).setZero();
      for (long j = 0; j < count; ++j) {
        const SparseVector& u = fresh[start + j]->u;
        for (std::size_t k = 0; k < u.index.size(); ++k) U_(u.index[k], j) = u.value[k];
      }
      const auto entries = static_cast<std::size_t>(size * count);
      stiffness.apply({U_.data(), entries}, {solved_.data(), entries});
      for (long j = 0; j < count; ++j) {
        Column& column = columns_.at(fresh[start + j]->id);
        column.u = fresh[start + j]->u;
        Y_.col(column.number) = solved_.col(j);
      }
    }
  }

  std::map<int, Column> columns_;  // by id
  std::vector<RankOneTerm> terms_;
  std::vector<long> column_of_;  // the column of each of terms_
  Eigen::MatrixXd Y_;
  Eigen::MatrixXd U_, solved_;  // some columns of U and of Y
  Eigen::PartialPivLU<Eigen::MatrixXd> inverse_;
};

}  // namespace gnomon
