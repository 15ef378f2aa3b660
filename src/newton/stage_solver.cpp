#include <gnomon/newton/stage_solver.hpp>

namespace gnomon {

NonlinearFunction algebraic_function(const System& system, const ActiveSet* piece) {
  NonlinearFunction function;
  function.residual = [&system, piece](std::span<const double> y, std::span<double> G) {
    system.residual({.y = y, .piece = piece}, G);
  };
  function.jacobian = [&system, piece](std::span<const double> y, std::span<double> values) {
    system.jacobian({.y = y, .piece = piece}, 0, values);
  };
  function.piece = [&system, piece](std::span<const double> y) {
    return piece ? *piece : active_set(system, 0, y);
  };
  function.switch_node = system.structure().switch_node;
  return function;
}

StageSolver::StageSolver(const System& system, Counters& counters) : stages_(system.make_stages()) {
  for (const Stage& stage : stages_) {
    newton_.push_back(
        std::make_unique<NewtonSolver>(stage.system->structure(), counters, modified_newton));
    unknowns_.emplace_back(stage.unknowns.size());
  }
}

std::string StageSolver::solve(double t, std::span<double> y, const ActiveSet* piece) {
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    const Stage& stage = stages_[s];
    std::vector<double>& part = unknowns_[s];
    stage.freeze(t, y);
    for (std::size_t k = 0; k < part.size(); ++k) part[k] = y[stage.unknowns[k]];
    const NewtonReport report = newton_[s]->solve(algebraic_function(*stage.system, piece), part);
    if (!report.converged) return report.reason;
    for (std::size_t k = 0; k < part.size(); ++k) y[stage.unknowns[k]] = part[k];
  }
  return {};
}

}  // namespace gnomon
