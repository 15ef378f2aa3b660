// The linear solver that a scene chooses, and the memory that it needs.
#pragma once

#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon {

/// The choice by the `solver.*` keys and the size of the mesh.
LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh);

/// Throws InputError where a run by this solver needs more memory than is available.
void require_memory(const Scene& scene, const MeshSize& mesh, const LinearSolverChoice& solver);

}  // namespace gnomon
