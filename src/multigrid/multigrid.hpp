// The two kinds of multigrid.
#pragma once

#include <gnomon/linear/inner_solver.hpp>
#include <memory>
#include <vector>

#include "linear/unknown_interpolation.hpp"

namespace gnomon {

/// Smoothed aggregation (GAMG) that uses the rigid-body modes.
std::unique_ptr<InnerSolver> make_algebraic_multigrid(const StiffnessLayout& layout);

/// A V-cycle with these interpolations, from the finest to the coarsest, and Galerkin products.
std::unique_ptr<InnerSolver> make_geometric_multigrid(
    const StiffnessLayout& layout, const std::vector<SparseRows>& interpolations);

}  // namespace gnomon
