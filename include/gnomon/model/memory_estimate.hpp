// Estimate of the memory of a run, before any of it is allocated.
#pragma once

#include <gnomon/newton/linear_solver_kind.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon {

/// Peak memory of a run by the linear solver that the scene chooses [bytes]: the program, a part
/// proportional to the unknowns (mesh, patterns, Jacobians), and the factors. In space the error is
/// less than 15 % from 3,000 nodes on where the factors are analysed, otherwise about a factor of
/// two, as in the plane, where their entries grow as n log n.
double estimated_memory(const Scene& scene, const MeshSize& mesh);

/// The memory that this process can still get without swapping [bytes]: the least of the system's
/// available memory and the limits of its control group and of its address space. Infinite if none
/// is known.
double available_memory();

/// What a run needs that is more than `available` [bytes], with the linear solver that the estimate
/// is for and, where another one gets by with what is available, that one: "1 GB of memory with
/// ...; expected ...". Empty if there is enough.
std::string missing_memory_text(const Scene& scene, const MeshSize& mesh, double needed,
                                double available);

/// The estimate; throws InputError where it is more than is available.
double required_memory(const Scene& scene, const MeshSize& mesh);

/// "3.2 GB".
std::string memory_text(double bytes);

}  // namespace gnomon
