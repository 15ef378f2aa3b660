// Linear solvers that scenes may name. A new one is one file in src/newton/catalogue with a
// Registration; nothing else has to change.
#pragma once

#include <functional>
#include <gnomon/scene/registry.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

/// Size of a body's mesh. Before the mesh exists, that which the keys of its scene say.
struct MeshSize {
  int dim = 2;
  double nodes = 0;
  double phases = 1;        ///< contact states
  bool grid_lines = false;  ///< in all directions, so that multigrid can follow them
  // In space:
  double displacements = 0;  ///< unknowns
  double shapes = 0;         ///< unknowns, except those of a cross-section
  /// Analyse the Cholesky factors of the stiffness and of the mesh motion: their entries. Empty
  /// before the mesh exists.
  std::function<double()> displacement_factor = {}, shape_factor = {};
};

/// A linear solver that scenes may name by solver.method.
struct LinearSolverKind {
  std::string name;
  std::string help;  ///< one line
  /// solver.*. They are optional or have a default, because they are in the tables of all scenes.
  std::vector<Key> keys;
  std::function<LinearSolverMaker(const Scene&, const MeshSize&)> make;
  /// Of the equations and the solver together, at the peak of a run [bytes].
  std::function<double(const Scene&, const MeshSize&)> memory;

  std::string missing() const { return !make ? "make" : !memory ? "memory" : ""; }  ///< Registry
};

/// The one that a scene names.
const LinearSolverKind& linear_solver_kind(const Scene& scene);

/// The solver of a structure; factors where it says nothing. Throws as LinearSolverMaker::make.
std::unique_ptr<LinearSolver> make_linear_solver(const Structure& structure, Counters& counters);

/// Factors of the whole Jacobian, which take no notice of the reduction.
std::unique_ptr<LinearSolver> make_direct_solver(const Structure& structure, Counters& counters);

/// Memory of Cholesky factors [bytes] by their analysis, or as usual for so many unknowns.
double factor_memory(const std::function<double()>& analysis, double unknowns);

}  // namespace gnomon
