#include <gnomon/integration/stage_solver.hpp>

namespace gnomon {

NonlinearFunction algebraic_function(const System& system) {
  return {[&system](std::span<const double> y, std::span<double> G) {
            system.residual(0, y, {}, G);
          },
          [&system](std::span<const double> y, std::span<double> values) {
            system.jacobian(0, y, {}, 0, values);
          }};
}

StageSolver::StageSolver(const System& system, Counters& counters)
    : stages_(system.make_stages()) {
  for (const Stage& stage : stages_) {
    newton_.push_back(std::make_unique<NewtonSolver>(stage.system->structure(), counters));
    unknowns_.emplace_back(stage.unknowns.size());
  }
}

std::string StageSolver::solve(std::span<double> y) {
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    const Stage& stage = stages_[s];
    std::vector<double>& part = unknowns_[s];
    stage.freeze(y);
    for (std::size_t k = 0; k < part.size(); ++k) part[k] = y[stage.unknowns[k]];
    const NewtonReport report = newton_[s]->solve(algebraic_function(*stage.system), part);
    if (!report.converged) return report.reason;
    for (std::size_t k = 0; k < part.size(); ++k) y[stage.unknowns[k]] = part[k];
  }
  return {};
}

}  // namespace gnomon
