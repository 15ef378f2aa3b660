// How much memory a run will take, told before any of it is allocated.
#pragma once

#include <gnomon/system/linear_solver_choice.hpp>
#include <string>

namespace gnomon {

/// Size of a body's mesh, told from the keys of its scene alone.
struct MeshSize {
  int dim = 2;
  double nodes = 0;
};

/// Peak memory of a run [bytes]: what grows with the nodes (mesh, patterns, Jacobians), and the
/// factors, whose entries grow as n log n in the plane and n^(4/3) in space under nested
/// dissection. The constants are measured (docs/linear.md); within a factor of two on the scenes
/// that come with gnomon.
double estimated_memory(const MeshSize& mesh, const LinearSolverChoice& solver);

/// What this process can still have without swapping [bytes]: by the system's account, the limit of
/// its control group and that of its address space. Infinite where none is known.
double available_memory();

/// "3.2 GB".
std::string memory_text(double bytes);

}  // namespace gnomon
