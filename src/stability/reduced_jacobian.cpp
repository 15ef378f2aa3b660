#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/stability/stability.hpp>

namespace gnomon {

ReducedJacobian::ReducedJacobian(const System& system, const State& state)
    : pattern_(system.structure().pattern),
      differential_rows_(pattern_.nonzeros(), 0.0),
      lu_(pattern_, system.structure().group),
      right_side_(state.y.size()),
      change_(state.y.size()) {
  const std::vector<char>& differential = system.structure().differential;
  for (int i = 0; i < pattern_.size(); ++i)
    if (differential[i]) components_.push_back(i);
  const ActiveSet branch = active_set(system, state.t, state.y);
  std::vector<double> values(pattern_.nonzeros());
  system.jacobian({state.t, state.y, state.ydot, &branch}, 0, values);
  // The differential rows are kept for the products and replaced by those of the identity.
  for (int column = 0; column < pattern_.size(); ++column)
    for (int k = pattern_.column_start[column]; k < pattern_.column_start[column + 1]; ++k) {
      const int row = pattern_.row_index[k];
      if (!differential[row]) continue;
      differential_rows_[k] = values[k];
      values[k] = row == column ? 1 : 0;
    }
  if (!lu_.factorize(values))
    throw SolutionError("no spectrum: the algebraic equations are singular at this state");
}

void ReducedJacobian::multiply(std::span<const double> v, std::span<double> Gv) const {
  std::fill(right_side_.begin(), right_side_.end(), 0.0);
  for (int i = 0; i < size(); ++i) right_side_[components_[i]] = v[i];
  lu_.solve(right_side_, change_);  // change of all components: v and the algebraic ones
  std::fill(right_side_.begin(), right_side_.end(), 0.0);
  for (int column = 0; column < pattern_.size(); ++column)
    for (int k = pattern_.column_start[column]; k < pattern_.column_start[column + 1]; ++k)
      right_side_[pattern_.row_index[k]] -= differential_rows_[k] * change_[column];
  for (int i = 0; i < size(); ++i) Gv[i] = right_side_[components_[i]];
}

Eigen::MatrixXd ReducedJacobian::dense() const {
  Eigen::MatrixXd G(size(), size());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(size());
  for (int j = 0; j < size(); ++j) {
    unit[j] = 1;
    multiply({unit.data(), components_.size()}, {G.col(j).data(), components_.size()});
    unit[j] = 0;
  }
  return G;
}

}  // namespace gnomon
