#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/stability/stability.hpp>

namespace gnomon {

namespace {

/// Residuals of the stages in products, in parts of their right sides. The Arnoldi iteration stops
/// at 1e-9 and cannot see errors of the products, so they are smaller.
constexpr double accuracy = 1e-10;
/// Where rounding prevents that, a residual that no longer halves is accepted below this value.
constexpr double acceptable = 1e-8;
/// One solve reduces a residual by not more than this; what is left is solved for again. A restart
/// from the true residual is not misled by rounding, as one solve down to 1e-10 may be.
constexpr double reduction_of_a_solve = 1e-6;

}  // namespace

/// The equations of a stage, linearized: their rows and columns of J.
struct ReducedJacobian::Stage {
  AlgebraicStage equations;
  std::vector<double> values;  // of its Jacobian
  std::unique_ptr<LinearSolver> linear;
  std::vector<double> right_side, solution;

  Stage(AlgebraicStage stage, const SparsePattern& pattern, std::span<const double> J,
        Counters& counters)
      : equations(std::move(stage)),
        linear(make_linear_solver(structure(), counters)),
        right_side(equations.unknowns.size()),
        solution(equations.unknowns.size()) {
    const std::vector<int>& unknown = equations.unknowns;
    const SparsePattern& own = structure().pattern;
    values.reserve(own.nonzeros());
    for (int column = 0; column < own.size(); ++column)
      for (int k = own.column_start[column]; k < own.column_start[column + 1]; ++k)
        values.push_back(J[pattern.find(unknown[own.row_index[k]], unknown[column])]);
    linear->set_up(values);
  }

  const Structure& structure() const { return equations.system->structure(); }

  /// Takes its rows of a residual of the whole system; returns their scaled Euclidean norm.
  double take(std::span<const double> residual) {
    double sum = 0;
    for (std::size_t k = 0; k < right_side.size(); ++k) {
      right_side[k] = residual[equations.unknowns[k]];
      sum += std::pow(right_side[k] / structure().row_scale[k], 2);
    }
    return std::sqrt(sum);
  }

  /// Adds its solution to the change of all components.
  void correct(double reduction, std::span<double> change) {
    linear->solve(right_side, solution, reduction);
    for (std::size_t k = 0; k < solution.size(); ++k) change[equations.unknowns[k]] += solution[k];
  }
};

ReducedJacobian::ReducedJacobian(const System& system, const State& state)
    : pattern_(system.structure().pattern),
      J_(pattern_.nonzeros()),
      change_(state.y.size()),
      residual_(state.y.size()) {
  const std::vector<char>& differential = system.structure().differential;
  for (int i = 0; i < pattern_.size(); ++i)
    if (differential[i]) components_.push_back(i);
  const ActiveSet branch = active_set(system, state.t, state.y);
  system.jacobian({state.t, state.y, state.ydot, &branch}, 0, J_);
  ++counters_.jacobian_evaluations;
  try {
    for (AlgebraicStage& stage : system.algebraic_stages())
      stages_.push_back(std::make_unique<Stage>(std::move(stage), pattern_, J_, counters_));
  } catch (const RecoverableError& error) {
    throw SolutionError(
        std::string("no spectrum: the algebraic equations are singular at this state: ") +
        error.what());
  }
}
ReducedJacobian::~ReducedJacobian() = default;

void ReducedJacobian::minus_jacobian_times_change() const {
  gnomon::multiply(pattern_, J_, change_, residual_);
  for (double& r : residual_) r = -r;
}

void ReducedJacobian::solve(Stage& stage) const {
  minus_jacobian_times_change();
  const double size = stage.take(residual_);
  for (double left = size, before = 2 * size; left > accuracy * size;) {
    if (left > before / 2) {
      if (left <= acceptable * size) return;
      throw RecoverableError("the linear solver did not converge");
    }
    // Half of what would be enough, because the residual is not exactly that of the solver.
    ++counters_.linear_solves;
    stage.correct(std::max(reduction_of_a_solve, accuracy * size / left / 2), change_);
    minus_jacobian_times_change();
    before = left;
    left = stage.take(residual_);
  }
}

void ReducedJacobian::multiply(std::span<const double> v, std::span<double> Gv) const {
  std::fill(change_.begin(), change_.end(), 0.0);
  for (int i = 0; i < size(); ++i) change_[components_[i]] = v[i];
  try {
    for (const auto& stage : stages_) solve(*stage);
  } catch (const RecoverableError& error) {
    throw SolutionError(
        std::string("no spectrum: the algebraic equations cannot be solved at this state: ") +
        error.what());
  }
  minus_jacobian_times_change();
  for (int i = 0; i < size(); ++i) Gv[i] = residual_[components_[i]];
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
