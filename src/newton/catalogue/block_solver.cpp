// Flexible GMRES on the whole Jacobian, preconditioned block by block; in the plane with factors of
// the whole Jacobian where this fails.

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>
#include <gnomon/scene/keys.hpp>
#include <limits>
#include <utility>

#include "newton/krylov.hpp"

namespace gnomon {

namespace {

/// Factors solve a system with which the blocks fail, as where the stiffness is not positive
/// definite. Where they are not affordable, what the blocks reach is taken.
class BlocksOrFactors : public LinearSolver {
public:
  BlocksOrFactors(const Structure& structure, Counters& counters, const InnerSolverMaker& inner,
                  bool affordable)
      : blocks_(structure, counters, inner) {
    if (affordable) factors_ = make_direct_solver(structure, counters);
  }

  void set_up(std::span<const double> J) override {
    if (!factors_) return blocks_.set_up(J);
    sundials::require_finite(J, "the Jacobian");  // factors would not help
    J_ = J;
    by_factors_ = rest_ > 0;
    if (by_factors_) {
      --rest_;
      factorize();
    } else
      try_blocks([&] { blocks_.set_up(J); });
  }

  void solve(std::span<const double> b, std::span<double> x, double reduction) override {
    if (!factors_) return blocks_.solve(b, x, std::min(reduction, loosest), useful);
    if (!by_factors_ && rest_ > 0) factorize();  // the last solve has given the blocks up
    if (!by_factors_) try_blocks([&] { solve_by_blocks(b, x, reduction); });
    if (by_factors_) factors_->solve(b, x, reduction);
  }

private:
  // An iteration of GMRES costs next to nothing, and a solve that stays behind is not accepted.
  // With 1e-4 a light load on a stiff, nearly incompressible pin takes 306 instead of 82 Newton
  // iterations.
  static constexpr double loosest = 1e-8;
  static constexpr double useful = 0.3;  // to Newton's method, where nothing better is affordable

  void solve_by_blocks(std::span<const double> b, std::span<double> x, double reduction) {
    // More iterations than this, with a fresh preconditioner, cost more than factors.
    constexpr int most_worth = 40;
    blocks_.solve(b, x, std::min(reduction, loosest), loosest);
    if (blocks_.fresh_iterations() > most_worth) give_up_blocks();
  }

  template <class Task>
  void try_blocks(const Task& task) {
    try {
      task();
    } catch (const RecoverableError&) {
      give_up_blocks();
      factorize();
    }
  }

  /// Where the blocks fail, or are slow, they mostly are so again: for some set-ups they are not
  /// tried, after the second time never.
  void give_up_blocks() {
    constexpr int set_ups_without_blocks = 20;
    constexpr int never = std::numeric_limits<int>::max();
    rest_ = std::exchange(given_up_, true) ? never : set_ups_without_blocks;
  }

  /// Until the next set-up, factors of the whole Jacobian solve.
  void factorize() {
    factors_->set_up(J_);
    by_factors_ = true;
  }

  sundials::BlockSolver blocks_;
  std::unique_ptr<LinearSolver> factors_;
  std::span<const double> J_;
  bool by_factors_ = false;
  int rest_ = 0;  // set-ups for which the blocks are not tried again
  bool given_up_ = false;
};

constexpr const char* preconditioner = "solver.preconditioner";

/// For a plane body factors are always inexpensive; in space, above some size, they cost more time
/// and far more memory than multigrid, which takes fewer iterations along grid lines than without
/// (docs/linear.md).
bool by_multigrid(const Scene& scene, const MeshSize& mesh) {
  if (scene.has(preconditioner)) return scene.text(preconditioner) == "multigrid";
  const double many_displacements = mesh.grid_lines ? 100'000 : 300'000;
  return mesh.dim == 3 && mesh.dim * mesh.nodes >= many_displacements && has_multigrid();
}

bool is_algebraic(const Structure& structure) {
  return std::ranges::count(structure.differential, 1) == 0;
}

/// Displacements of all phases. Their common shape fills the factors: with 50,000 they take a
/// minute and several gigabytes.
constexpr double most_for_factors = 30'000;

/// In the plane factors solve the algebraic stages in less time; those of several phases are large.
LinearSolverMaker make(const Scene& scene, const MeshSize& mesh) {
  const bool multigrid = by_multigrid(scene, mesh), plane = mesh.dim == 2,
             direct_stages = plane && mesh.phases == 1 && !multigrid,
             affordable = mesh.phases * 2 * mesh.nodes < most_for_factors || mesh.phases == 1;
  return {.make = [inner = multigrid ? multigrid_solvers() : factor_solvers(), plane, direct_stages,
                   affordable](const Structure& s,
                               Counters& counters) -> std::unique_ptr<LinearSolver> {
            if (direct_stages && is_algebraic(s)) return make_direct_solver(s, counters);
            if (plane) return std::make_unique<BlocksOrFactors>(s, counters, inner, affordable);
            return std::make_unique<sundials::BlockSolver>(s, counters, inner);
          },
          .keys = {{preconditioner, multigrid ? "multigrid" : "factor"}},
          .coarsens = multigrid};
}

/// Without PETSc, multigrid is not offered as what needs less.
double memory(const Scene& scene, const MeshSize& mesh) {
  constexpr double megabyte = 1e6, kilobyte = 1e3;
  if (mesh.dim == 2)
    return kilobyte * mesh.nodes *
           (5 + 0.35 * std::log2(std::max(2.0, mesh.nodes)) + 3.5 * (mesh.phases - 1));
  const double u = mesh.displacements / 3, d = mesh.shapes / 3;
  const double further = kilobyte * 11.5 * u * (mesh.phases - 1);  // share the factors
  if (by_multigrid(scene, mesh) && has_multigrid())
    return 26 * megabyte + kilobyte * (25.6 * u + 12.3 * d) + further;
  return kilobyte * (25.8 * u + 5.9 * d) + further +
         factor_memory(mesh.displacement_factor, mesh.displacements) +
         factor_memory(mesh.shape_factor, mesh.shapes);
}

const Registration<LinearSolverKind> registration(
    {.name = "block",
     .help = "flexible GMRES on the whole Jacobian, preconditioned block by block",
     .keys = {resumable(text_key(
         preconditioner, absent("chosen by size: factor unless in 3D and large (docs/linear.md)"),
         "how solver.method = \"block\" solves with the stiffness: by Cholesky "
         "factors, or by multigrid, along the grid lines of the mesh where it has "
         "them (needs PETSc)",
         {"factor", "multigrid"}))},
     .make = make,
     .memory = memory});

}  // namespace

}  // namespace gnomon
