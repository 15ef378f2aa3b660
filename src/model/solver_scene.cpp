#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/model/solver_scene.hpp>

namespace gnomon {

namespace {

using Preconditioner = LinearSolverChoice::Preconditioner;

/// For a plane body factors are always inexpensive; in space, above some size, they cost more time
/// and far more memory than multigrid, which takes fewer iterations along grid lines than without
/// (docs/linear.md).
Preconditioner preconditioner_by_size(const MeshSize& mesh) {
  const double many_displacements = mesh.grid_lines ? 100'000 : 300'000;
  return mesh.dim == 3 && mesh.dim * mesh.nodes >= many_displacements && has_multigrid()
             ? Preconditioner::multigrid
             : Preconditioner::factor;
}

}  // namespace

LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh) {
  const bool direct = scene.has("solver.method") && scene.text("solver.method") == "direct";
  Preconditioner preconditioner = preconditioner_by_size(mesh);
  if (scene.has("solver.preconditioner"))
    preconditioner = scene.text("solver.preconditioner") == "factor" ? Preconditioner::factor
                                                                     : Preconditioner::multigrid;
  return {direct ? LinearSolverChoice::Method::direct : LinearSolverChoice::Method::block,
          preconditioner, mesh.dim == 2};
}

void require_memory(const Scene& scene, const MeshSize& mesh, const LinearSolverChoice& solver) {
  if (const std::string missing = missing_memory_text(mesh, solver, available_memory());
      !missing.empty())
    throw InputError(fmt::format("{}: its mesh needs {}", scene.path().string(), missing));
}

}  // namespace gnomon
