// Estimate of the memory of a run, before any of it is allocated.
#pragma once

#include <gnomon/system/linear_solver_choice.hpp>
#include <string>

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
  /// Entries of the Cholesky factors of the stiffness and of the mesh motion; 0: not analysed.
  double displacement_factor = 0, shape_factor = 0;
};

/// Peak memory of a run [bytes]: the program, a part proportional to the unknowns (mesh, patterns,
/// Jacobians), and the factors. The constants are measured (docs/notes/linear.md). In space the
/// error is less than 15 % from 3,000 nodes on where the factors are analysed, otherwise about a
/// factor of two, as in the plane, where their entries grow as n log n.
double estimated_memory(const MeshSize& mesh, const LinearSolverChoice& solver);

/// The memory that this process can still get without swapping [bytes]: the least of the system's
/// available memory and the limits of its control group and of its address space. Infinite if none
/// is known.
double available_memory();

/// What a run needs by its solver that is more than `available` [bytes], with the linear solver
/// that the estimate is for and, where another one gets by with what is available, that one: "1 GB
/// of memory with ...; expected ...". Empty if there is enough.
std::string missing_memory_text(const MeshSize& mesh, const LinearSolverChoice& solver,
                                double available);

/// "3.2 GB".
std::string memory_text(double bytes);

}  // namespace gnomon
