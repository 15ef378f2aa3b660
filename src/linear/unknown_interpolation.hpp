// Interpolation between the unknowns of the levels of geometric multigrid.
#pragma once

#include <Eigen/SparseCore>
#include <gnomon/linear/inner_solver.hpp>
#include <vector>

namespace gnomon {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Between the unknowns of `layout` and the next coarser ones, and so on to the coarsest. A node's
/// components are interpolated alike. Held values are zero on every level: a coarse node has the
/// unknowns that it has on the finest level. Levels that would only number the same unknowns again
/// are left out.
std::vector<SparseRows> unknown_interpolations(const StiffnessLayout& layout);

}  // namespace gnomon
