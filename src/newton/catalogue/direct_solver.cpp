// Sparse LU of the whole Jacobian.

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>
#include <optional>

namespace gnomon {

namespace {

class DirectSolver : public LinearSolver {
public:
  DirectSolver(const Structure& structure, Counters& counters)
      : structure_(structure), counters_(counters) {}

  void set_up(std::span<const double> J) override {
    if (!lu_) lu_.emplace(structure_.pattern, structure_.group);
    ++counters_.factorizations;
    if (!lu_->factorize(J)) throw RecoverableError("the Jacobian is singular");
  }
  void solve(std::span<const double> b, std::span<double> x, double) override {
    if (x.data() != b.data()) return lu_->solve(b, x);
    const std::vector<double> right(b.begin(), b.end());  // IDA solves in place
    lu_->solve(right, x);
  }

private:
  const Structure& structure_;
  Counters& counters_;
  std::optional<SparseLu> lu_;  // made when first needed
};

/// The constants are measured (docs/linear.md), as all estimates of memory.
double memory(const Scene&, const MeshSize& mesh) {
  constexpr double kilobyte = 1e3;
  if (mesh.dim == 2)
    return kilobyte * mesh.nodes * mesh.phases * (11 + 0.5 * std::log2(std::max(2.0, mesh.nodes)));
  const double together = std::pow(1 + mesh.shapes / std::max(1.0, mesh.displacements), 2);
  const double stiffness = factor_memory(mesh.displacement_factor, mesh.displacements);
  return mesh.phases * (kilobyte * 24 * mesh.displacements / 3 + 4 * together * stiffness);
}

const Registration<LinearSolverKind> registration(
    {.name = "direct",
     .help = "factors of the whole Jacobian (UMFPACK)",
     .keys = {},
     .make = [](const Scene&, const MeshSize&) { return LinearSolverMaker{make_direct_solver}; },
     .memory = memory});

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const Structure& structure, Counters& counters) {
  return std::make_unique<DirectSolver>(structure, counters);
}

}  // namespace gnomon
