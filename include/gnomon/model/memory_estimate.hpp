// Estimate of the memory of a run, before any of it is allocated.
#pragma once

#include <gnomon/system/linear_solver_choice.hpp>
#include <string>

namespace gnomon {

/// Size of a body's mesh, computed only from the keys of its scene.
struct MeshSize {
  int dim = 2;
  double nodes = 0;
};

/// Peak memory of a run [bytes]: a part proportional to the nodes (mesh, patterns, Jacobians), and
/// the factors, whose entries grow as n log n in the plane and n^(4/3) in space under nested
/// dissection. The constants are measured (docs/linear.md); the error is less than a factor of two
/// on the scenes that come with gnomon.
double estimated_memory(const MeshSize& mesh, const LinearSolverChoice& solver);

/// The memory that this process can still get without swapping [bytes]: the least of the system's
/// available memory and the limits of its control group and of its address space. Infinite if none
/// is known.
double available_memory();

/// "3.2 GB".
std::string memory_text(double bytes);

}  // namespace gnomon
