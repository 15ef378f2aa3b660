#include <gnomon/newton/algebraic_solver.hpp>
#include <utility>

namespace gnomon {

NonlinearFunction algebraic_function(const System& system, const ActiveSet* branch) {
  NonlinearFunction function;
  function.residual = [&system, branch](std::span<const double> y, std::span<double> G) {
    system.residual({.y = y, .branch = branch}, G);
  };
  function.jacobian = [&system, branch](std::span<const double> y, std::span<double> values) {
    system.jacobian({.y = y, .branch = branch}, 0, values);
  };
  function.branch = [&system, branch](std::span<const double> y) {
    return branch ? *branch : active_set(system, 0, y);
  };
  function.switch_node = system.structure().switch_node;
  return function;
}

AlgebraicSolver::AlgebraicSolver(const System& system, Counters& counters, double fraction) {
  for (AlgebraicStage& equations : system.algebraic_stages()) {
    auto newton = std::make_unique<NewtonSolver>(equations.system->structure(), counters,
                                                 within_time_error(modified_newton, fraction));
    std::vector<double> unknowns(equations.unknowns.size());
    subproblems_.push_back({std::move(equations), std::move(newton), std::move(unknowns)});
  }
}

std::string AlgebraicSolver::solve(double t, std::span<double> y, const ActiveSet* branch,
                                   const Distance& distance) {
  for (Subproblem& subproblem : subproblems_) {
    const auto& [equations, newton, unknowns] = subproblem;
    equations.freeze(t, y);
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      subproblem.unknowns[k] = y[equations.unknowns[k]];
    NonlinearFunction function = algebraic_function(*equations.system, branch);
    if (distance)
      function.distance = [&, last = std::vector<double>(y.begin(), y.end())](
                              std::span<const double> before, std::span<const double> now) mutable {
        put(subproblem, before, last);
        put(subproblem, now, y);
        return distance(last, y);
      };
    const NewtonReport report = newton->solve(function, subproblem.unknowns);
    if (!report.converged) return report.reason;
    put(subproblem, subproblem.unknowns, y);
  }
  return {};
}

void AlgebraicSolver::put(const Subproblem& subproblem, std::span<const double> unknowns,
                          std::span<double> y) {
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    y[subproblem.equations.unknowns[k]] = unknowns[k];
}

}  // namespace gnomon
