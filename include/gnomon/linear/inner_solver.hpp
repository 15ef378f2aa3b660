// Approximate inverses of the stiffness blocks that precondition a coupled solve.
#pragma once

#include <array>
#include <functional>
#include <gnomon/fields/sparse_pattern.hpp>
#include <gnomon/mesh/node_interpolation.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// A symmetric matrix of nodal unknowns, and the positions of the nodes.
struct StiffnessLayout {
  SparsePattern lower;                          ///< lower triangle with the diagonal
  std::vector<int> group;                       ///< size entries: the node of an unknown
  std::vector<char> component;                  ///< size entries: 0, 1, 2 of a vector
  std::vector<std::array<double, 3>> position;  ///< of a `group` [length]
  /// From the nodes of the mesh, which are the groups, to coarser ones; null: none are known.
  std::shared_ptr<const std::vector<NodeInterpolation>> coarsening = {};
};

/// An approximate inverse of a symmetric matrix, which is usually positive definite.
class InnerSolver {
public:
  virtual ~InnerSolver() = default;

  /// Takes the values on `lower`. Returns false when the matrix is singular or not finite.
  virtual bool set_up(std::span<const double> values) = 0;
  /// x = approximately K^-1 b, for one or more columns, stored one after the other. It is the same
  /// linear map until the next set-up, up to rounding.
  virtual void apply(std::span<const double> b, std::span<double> x) = 0;
  /// Number of numeric factorizations in the last set-up.
  virtual int factorizations() const = 0;
  /// Cost of the last set-up, in applications.
  virtual double set_up_cost() const = 0;
};

/// Inner solvers of one kind.
struct InnerSolverMaker {
  /// The layout must outlive the solver.
  std::function<std::unique_ptr<InnerSolver>(const StiffnessLayout&)> make;
  double column_cost;  ///< of one of many columns, in applications; below 1 many are worthwhile
};

/// Sizes from which factors are treated as large.
struct FactorSizes {
  double rounded = 5e6;  ///< entries, more than caches hold: single columns in single precision
  double threads = 1e9;  ///< operations for several columns: divided among threads
};

/// Supernodal Cholesky factors (CHOLMOD) ordered by nested dissection. For a matrix that is not
/// positive definite, as between two distant equilibria, the diagonal is increased by 1, 10 or 100
/// %; the outer iteration corrects this. `layout` must outlive the solver.
std::unique_ptr<InnerSolver> make_factor_solver(const StiffnessLayout& layout,
                                                const FactorSizes& sizes = {});
InnerSolverMaker factor_solvers();

/// Entries of the factors of a symmetric matrix on this pattern, ordered in the same way; only
/// counted.
double factor_entries(const SparsePattern& pattern);

/// Whether gnomon was built with PETSc.
bool has_multigrid();

/// One cycle of multigrid: geometric where `layout` has a coarsening, otherwise smoothed
/// aggregation (PETSc GAMG) that uses the rigid-body modes. Throws InputError where gnomon was
/// built without PETSc. `layout` must outlive the solver.
std::unique_ptr<InnerSolver> make_multigrid_solver(const StiffnessLayout& layout);
InnerSolverMaker multigrid_solvers();

}  // namespace gnomon
