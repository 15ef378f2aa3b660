// Approximate inverses of the stiffness blocks that precondition a coupled solve.
#pragma once

#include <array>
#include <gnomon/fields/sparse_pattern.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// A symmetric matrix of nodal unknowns, and where they lie.
struct StiffnessLayout {
  SparsePattern lower;                          ///< lower triangle with the diagonal
  std::vector<int> group;                       ///< size entries: the node of an unknown
  std::vector<char> component;                  ///< size entries: 0, 1, 2 of a vector
  std::vector<std::array<double, 3>> position;  ///< of a `group` [length]
};

/// What stands for the inverse of a symmetric matrix, usually positive definite.
class InnerSolver {
public:
  virtual ~InnerSolver() = default;

  /// Takes the values on `lower`. Returns false when the matrix is singular or not finite.
  virtual bool set_up(std::span<const double> values) = 0;
  /// x = approximately K^-1 b, of one or more columns one behind the other. The same linear map
  /// until the next set-up, up to rounding.
  virtual void apply(std::span<const double> b, std::span<double> x) = 0;
  /// Numeric factorizations that the last set-up made.
  virtual int factorizations() const = 0;
  /// What the last set-up cost, in applications.
  virtual double set_up_cost() const = 0;
};

/// From when on large factors are treated as such.
struct FactorSizes {
  double rounded = 5e6;  ///< entries, which no cache holds: single columns by single precision
  double threads = 1e9;  ///< operations on columns: divided among threads
};

/// Supernodal Cholesky factors (CHOLMOD) ordered by nested dissection. Of a matrix that is not
/// positive definite, as between two equilibria far apart, with the diagonal raised by 1, 10 or 100
/// %: what the outer iteration makes up for. `layout` must outlive the solver.
std::unique_ptr<InnerSolver> make_factor_solver(const StiffnessLayout& layout,
                                                const FactorSizes& sizes = {});

/// Whether gnomon was built with PETSc.
bool has_multigrid();

/// One cycle of smoothed-aggregation multigrid (PETSc GAMG) that knows the rigid-body modes. Throws
/// InputError where gnomon was built without PETSc. `layout` must outlive the solver.
std::unique_ptr<InnerSolver> make_multigrid_solver(const StiffnessLayout& layout);

}  // namespace gnomon
