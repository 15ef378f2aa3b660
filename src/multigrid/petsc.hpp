// What both kinds of multigrid need from PETSc. Only this module uses it; src/linear/multigrid.cpp
// loads the module on first use.
#pragma once

#include <petscksp.h>

#include <algorithm>
#include <cstdlib>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <mutex>
#include <string>
#include <vector>

namespace gnomon {

/// Throws Error if a call of PETSc failed.
inline void check(PetscErrorCode code) {
  if (code) throw Error("PETSc failed with code " + std::to_string(code));
}

/// PETSc may be used by one thread at a time. Recursive: a solver that could not be made is
/// destroyed by who makes it.
inline std::recursive_mutex petsc_in_use;

/// One application of a preconditioner of PETSc. The matrix may have more rows than the layout has
/// unknowns; those rows hold only a diagonal, the largest of all values.
class PetscSolver : public InnerSolver {
public:
  ~PetscSolver() override {
    const std::scoped_lock alone(petsc_in_use);
    PetscBool over = PETSC_FALSE;
    PetscFinalized(&over);
    if (over) return;
    PCDestroy(&multigrid_);
    MatDestroy(&matrix_);
    VecDestroy(&right_);
    VecDestroy(&solution_);
  }
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  bool set_up(std::span<const double> values) override {
    const std::scoped_lock alone(petsc_in_use);
    double largest = 0;
    for (double value : values) largest = std::max(largest, std::abs(value));
    if (!(largest > 0 && largest < 1e300)) return false;
    PetscScalar* place = nullptr;
    check(MatSeqAIJGetArrayWrite(matrix_, &place));
    for (std::size_t k = 0; k < source_.size(); ++k)
      place[k] = source_[k] < 0 ? largest : values[source_[k]];
    check(MatSeqAIJRestoreArrayWrite(matrix_, &place));
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    if (PCSetUp(multigrid_)) return false;
    adjust();
    PCFailedReason failed = PC_NOERROR;
    check(PCGetFailedReason(multigrid_, &failed));
    return failed == PC_NOERROR;
  }

  void apply(std::span<const double> b, std::span<double> x) override {
    const std::scoped_lock alone(petsc_in_use);
    const std::size_t size = row_.size();
    for (std::size_t start = 0; start < b.size(); start += size)
      apply_to_one(b.subspan(start, size), x.subspan(start, size));
  }
  int factorizations() const override { return 0; }

protected:
  /// `row`: of each unknown.
  PetscSolver(const StiffnessLayout& layout, std::vector<int> row, int rows)
      : row_(std::move(row)) {
    initialize_petsc();
    build_pattern(layout.lower, rows);
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows, rows, start_.data(), column_.data(),
                                    values_.data(), &matrix_));
    check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
    check(MatCreateVecs(matrix_, &solution_, &right_));
    check(PCCreate(PETSC_COMM_SELF, &multigrid_));
    check(PCSetOperators(multigrid_, matrix_, matrix_));
  }

  /// Called after every set-up of the preconditioner, whose levels exist only then.
  virtual void adjust() {}

  Mat matrix_ = nullptr;
  PC multigrid_ = nullptr;

private:
  /// Called once per process; PETSc does not change signals, standard streams or the user's
  /// settings.
  static void initialize_petsc() {
    PetscBool initialized = PETSC_FALSE;
    check(PetscInitialized(&initialized));
    if (initialized) return;
    // There is only one process: without these settings OpenMPI searches for networks, which is
    // slow, and prints which ones are missing.
    setenv("OMPI_MCA_btl", "self", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_opal_signal", "", 0);  // the program handles signals itself
    check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
    check(PetscOptionsSetValue(nullptr, "-skip_petscrc", "true"));
    check(PetscInitializeNoArguments());
    // Algebraic multigrid asks for options of its own accord: those of PETSC_OPTIONS and of files
    // of the user would change the solver of a run without a trace in its result.
    check(PetscOptionsClear(nullptr));
    check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    std::atexit([] { PetscFinalize(); });
  }

  void build_pattern(const SparsePattern& lower, int size) {
    struct Entry {
      PetscInt column, source;
    };
    std::vector<std::vector<Entry>> rows(size);
    for (int j = 0; j < lower.size(); ++j)
      for (int k = lower.column_start[j]; k < lower.column_start[j + 1]; ++k) {
        const int row = row_[lower.row_index[k]], column = row_[j];
        rows[row].push_back({column, k});
        if (row != column) rows[column].push_back({row, k});
      }
    start_.push_back(0);
    for (int i = 0; i < size; ++i) {
      if (rows[i].empty()) rows[i].push_back({i, -1});
      std::sort(rows[i].begin(), rows[i].end(),
                [](const Entry& a, const Entry& b) { return a.column < b.column; });
      for (const Entry& entry : rows[i]) {
        column_.push_back(entry.column);
        source_.push_back(entry.source);
      }
      start_.push_back(static_cast<PetscInt>(column_.size()));
      std::vector<Entry>().swap(rows[i]);
    }
    values_.resize(column_.size());
  }

  void apply_to_one(std::span<const double> b, std::span<double> x) {
    PetscScalar* right = nullptr;
    check(VecGetArrayWrite(right_, &right));
    std::fill_n(right, start_.size() - 1, 0.0);
    for (std::size_t k = 0; k < b.size(); ++k) right[row_[k]] = b[k];
    check(VecRestoreArrayWrite(right_, &right));
    check(PCApply(multigrid_, right_, solution_));
    const PetscScalar* solution = nullptr;
    check(VecGetArrayRead(solution_, &solution));
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = solution[row_[k]];
    check(VecRestoreArrayRead(solution_, &solution));
  }

  std::vector<int> row_;
  std::vector<PetscInt> start_, column_;
  std::vector<PetscInt> source_;  // in the values on `lower`; -1: a row without unknown
  std::vector<PetscScalar> values_;
  Vec right_ = nullptr, solution_ = nullptr;
};

}  // namespace gnomon
