#include "linear/spring_update.hpp"

namespace gnomon {

void SpringUpdate::clear() {
  springs_.clear();
  Y_.resize(0, 0);
}

void SpringUpdate::append(std::span<const SpringDirection> springs, InnerSolver& stiffness,
                          long size) {
  const long before = columns(), added = static_cast<long>(springs.size());
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(size, added);
  for (long j = 0; j < added; ++j)
    for (int i = 0; i < 3; ++i) V(springs[j].unknown[i], j) += springs[j].v[i];
  Y_.conservativeResize(size, before + added);
  stiffness.apply({V.data(), static_cast<std::size_t>(V.size())},
                  {Y_.data() + size * before, static_cast<std::size_t>(V.size())});
  springs_.insert(springs_.end(), springs.begin(), springs.end());
}

double SpringUpdate::along(std::size_t spring, const double* x) const {
  const auto& [unknown, v] = springs_[spring];
  return v[0] * x[unknown[0]] + v[1] * x[unknown[1]] + v[2] * x[unknown[2]];
}

void SpringUpdate::change(const Eigen::VectorXd& k) {
  k_ = k;
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(columns(), columns());
  for (long j = 0; j < columns(); ++j)
    for (long i = 0; i < columns(); ++i) M(i, j) += k[i] * along(i, Y_.col(j).data());
  inverse_.compute(M);
}

void SpringUpdate::correct(std::span<double> x) const {
  if (springs_.empty()) return;
  Eigen::VectorXd s(columns());
  for (long i = 0; i < columns(); ++i) s[i] = k_[i] * along(i, x.data());
  Eigen::Map<Eigen::VectorXd>(x.data(), Y_.rows()) -= Y_ * inverse_.solve(s);
}

}  // namespace gnomon
