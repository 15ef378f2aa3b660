#include <numeric>

#include "multigrid/multigrid.hpp"
#include "multigrid/petsc.hpp"

namespace gnomon {

namespace {

std::vector<int> own_numbers(const StiffnessLayout& layout) {
  std::vector<int> numbers(layout.group.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

class GeometricMultigrid : public PetscSolver {
public:
  GeometricMultigrid(const StiffnessLayout& layout, const std::vector<SparseRows>& interpolations)
      : PetscSolver(layout, own_numbers(layout), static_cast<int>(layout.group.size())) {
    const auto finest = static_cast<PetscInt>(interpolations.size());
    check(PCSetType(multigrid_, PCMG));
    check(PCMGSetLevels(multigrid_, finest + 1, nullptr));
    check(PCMGSetType(multigrid_, PC_MG_MULTIPLICATIVE));
    check(PCMGSetCycleType(multigrid_, PC_MG_CYCLE_V));
    check(PCMGSetGalerkin(multigrid_, PC_MG_GALERKIN_BOTH));
    check(PCMGSetNumberSmooth(multigrid_, 1));
    for (PetscInt level = finest; level > 0; --level) {
      interpolate(level, interpolations[finest - level]);
      choose_sweeps(level);
    }
    choose_coarse_solver();
  }

  double set_up_cost() const override { return 2; }

private:
  void interpolate(PetscInt level, const SparseRows& rows) {
    const auto count = static_cast<PetscInt>(rows.start.size()) - 1;
    std::vector<PetscInt> entries;
    for (PetscInt k = 0; k < count; ++k) entries.push_back(rows.start[k + 1] - rows.start[k]);
    Mat matrix = nullptr;
    check(MatCreateSeqAIJ(PETSC_COMM_SELF, count, rows.columns, 0, entries.data(), &matrix));
    for (PetscInt k = 0; k < count; ++k)
      check(MatSetValues(matrix, 1, &k, entries[k], rows.column.data() + rows.start[k],
                         rows.value.data() + rows.start[k], INSERT_VALUES));
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    check(PCMGSetInterpolation(multigrid_, level, matrix));
    check(MatDestroy(&matrix));
  }

  void choose_sweeps(PetscInt level) {
    KSP smoother = nullptr;
    PC sweep = nullptr;
    check(PCMGGetSmoother(multigrid_, level, &smoother));
    check(KSPSetType(smoother, KSPRICHARDSON));
    check(KSPGetPC(smoother, &sweep));
    check(PCSetType(sweep, PCSOR));
    check(PCSORSetSymmetric(sweep, SOR_LOCAL_SYMMETRIC_SWEEP));
  }
  void choose_coarse_solver() {
    KSP solver = nullptr;
    PC factor = nullptr;
    check(PCMGGetCoarseSolve(multigrid_, &solver));
    check(KSPSetType(solver, KSPPREONLY));
    check(KSPGetPC(solver, &factor));
    check(PCSetType(factor, PCLU));
  }
};

}  // namespace

std::unique_ptr<InnerSolver> make_geometric_multigrid(
    const StiffnessLayout& layout, const std::vector<SparseRows>& interpolations) {
  return std::make_unique<GeometricMultigrid>(layout, interpolations);
}

}  // namespace gnomon
