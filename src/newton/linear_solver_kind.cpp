#include <algorithm>
#include <cmath>
#include <gnomon/newton/linear_solver_kind.hpp>

namespace gnomon {

const LinearSolverKind& linear_solver_kind(const Scene& scene) {
  return Registry<LinearSolverKind>::find(scene.text("solver.method"), "solver");
}

std::unique_ptr<LinearSolver> make_linear_solver(const Structure& structure, Counters& counters) {
  const auto& make = structure.solver.make;
  return make ? make(structure, counters) : make_direct_solver(structure, counters);
}

namespace {

/// Entries of the Cholesky factors of three unknowns at each node of a compact body.
double usual_factor(double unknowns) {
  const double nodes = unknowns / 3;
  return 9 * nodes * std::max(10.0, 10.6 * std::cbrt(nodes) - 22);
}

}  // namespace

/// Large factors have a copy in single precision; CHOLMOD stores zeros among the entries.
double factor_memory(const std::function<double()>& analysis, double unknowns) {
  constexpr double stored = 1.23, large = 5e6;
  const double entries = analysis ? analysis() : usual_factor(unknowns) / stored;
  return stored * entries * (entries < large ? 8 : 12);
}

}  // namespace gnomon
