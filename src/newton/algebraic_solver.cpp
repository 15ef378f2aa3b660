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

AlgebraicSolver::AlgebraicSolver(const System& system, Counters& counters) {
  for (AlgebraicStage& equations : system.algebraic_stages()) {
    auto newton =
        std::make_unique<NewtonSolver>(equations.system->structure(), counters, modified_newton);
    std::vector<double> unknowns(equations.unknowns.size());
    subproblems_.push_back({std::move(equations), std::move(newton), std::move(unknowns)});
  }
}

std::string AlgebraicSolver::solve(double t, std::span<double> y, const ActiveSet* branch) {
  for (auto& [equations, newton, unknowns] : subproblems_) {
    equations.freeze(t, y);
    for (std::size_t k = 0; k < unknowns.size(); ++k) unknowns[k] = y[equations.unknowns[k]];
    const NewtonReport report =
        newton->solve(algebraic_function(*equations.system, branch), unknowns);
    if (!report.converged) return report.reason;
    for (std::size_t k = 0; k < unknowns.size(); ++k) y[equations.unknowns[k]] = unknowns[k];
  }
  return {};
}

}  // namespace gnomon
