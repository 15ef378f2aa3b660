#include "linear/low_rank_update.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon {

double SparseVector::dot(const double* x) const {
  double sum = 0;
  for (std::size_t k = 0; k < index.size(); ++k) sum += value[k] * x[index[k]];
  return sum;
}

namespace {

/// The largest entry of |a - b| divided by that of |b|; b must not be zero. 1 if their patterns
/// differ.
double turned(const SparseVector& a, const SparseVector& b) {
  if (a.index != b.index) return 1;
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    const double here = std::abs(a.value[k] - b.value[k]);
    if (!(here <= difference)) difference = here;  // a NaN counts as a difference
    size = std::max(size, std::abs(b.value[k]));
  }
  return difference / size;
}

}  // namespace

void LowRankUpdate::clear() {
  columns_.clear();
  terms_.clear();
  column_of_.clear();
  Y_.resize(0, 0);
}

bool LowRankUpdate::serves(const RankOneTerm& term) const {
  constexpr double tolerance = 0.1;
  const auto found = columns_.find(term.id);
  return found != columns_.end() && turned(found->second.u, term.u) < tolerance;
}

long LowRankUpdate::columns_to_solve(const std::vector<RankOneTerm>& terms) const {
  return std::count_if(terms.begin(), terms.end(),
                       [this](const RankOneTerm& term) { return !serves(term); });
}

void LowRankUpdate::solve(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness,
                          long size) {
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

void LowRankUpdate::set(const std::vector<RankOneTerm>& terms, InnerSolver& stiffness, long size) {
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

void LowRankUpdate::correct(std::span<double> x) const {
  if (terms_.empty()) return;
  Eigen::VectorXd s(static_cast<long>(terms_.size())), y = Eigen::VectorXd::Zero(Y_.cols());
  for (std::size_t i = 0; i < terms_.size(); ++i) s[i] = terms_[i].k * terms_[i].v.dot(x.data());
  s = inverse_.solve(s);
  for (std::size_t i = 0; i < terms_.size(); ++i) y[column_of_[i]] = s[i];
  Eigen::Map<Eigen::VectorXd>(x.data(), Y_.rows()).noalias() -= Y_ * y;
}

}  // namespace gnomon
