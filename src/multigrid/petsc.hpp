// What both kinds of multigrid need from PETSc. Only this module uses it; src/linear/multigrid.cpp
// loads the module on first use.
#pragma once

#include <petscksp.h>

#include <gnomon/linear/inner_solver.hpp>
#include <vector>

namespace gnomon {

/// Throws Error if a call of PETSc failed.
void check(PetscErrorCode code);

/// Called once per process; PETSc does not change signals, standard streams or the user's settings.
void initialize_petsc();

/// One application of a preconditioner of PETSc. The matrix may have more rows than the layout has
/// unknowns; those rows hold only a diagonal, the largest of all values.
class PetscSolver : public InnerSolver {
public:
  ~PetscSolver() override;
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  bool set_up(std::span<const double> values) override;
  void apply(std::span<const double> b, std::span<double> x) override;
  int factorizations() const override { return 0; }

protected:
  /// `row`: of each unknown.
  PetscSolver(const StiffnessLayout& layout, std::vector<int> row, int rows);
  /// Called after every set-up of the preconditioner, whose levels exist only then.
  virtual void adjust() {}

  Mat matrix_ = nullptr;
  PC multigrid_ = nullptr;

private:
  void build_pattern(const SparsePattern& lower, int rows);
  void apply_to_one(std::span<const double> b, std::span<double> x);

  std::vector<int> row_;
  std::vector<PetscInt> start_, column_;
  std::vector<PetscInt> source_;  // in the values on `lower`; -1: a row without unknown
  std::vector<PetscScalar> values_;
  Vec right_ = nullptr, solution_ = nullptr;
};

}  // namespace gnomon
