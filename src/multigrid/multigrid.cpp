// The two kinds of multigrid, as src/linear/multigrid.cpp finds them in this module.

#include <algorithm>
#include <numeric>

#include "linear/unknown_interpolation.hpp"
#include "multigrid/petsc.hpp"

namespace gnomon {

namespace {

/// Every node with all its components, including those that are held: rows dim * node + component.
struct Nodes {
  int dim = 1;
  std::vector<int> group;  // of each node
  std::vector<int> row;    // of each unknown
  std::vector<char> held;  // of each row

  explicit Nodes(const StiffnessLayout& layout) {
    for (char component : layout.component) dim = std::max(dim, component + 1);
    std::vector<int> node_of(layout.position.size(), -1);
    for (std::size_t k = 0; k < layout.group.size(); ++k) {
      int& node = node_of[layout.group[k]];
      if (node < 0) {
        node = static_cast<int>(group.size());
        group.push_back(layout.group[k]);
      }
      row.push_back(dim * node + layout.component[k]);
    }
    held.assign(dim * group.size(), 1);
    for (int n : row) held[n] = 0;
  }
};

/// Smoothed aggregation (GAMG) that uses the rigid-body modes.
class AlgebraicMultigrid : public PetscSolver {
public:
  AlgebraicMultigrid(const StiffnessLayout& layout, const Nodes& nodes)
      : PetscSolver(layout, nodes.row, static_cast<int>(nodes.held.size())) {
    check(MatSetBlockSize(matrix_, nodes.dim));
    know_rigid_modes(layout, nodes);
    check(PCSetType(multigrid_, PCGAMG));
    check(PCGAMGSetReuseInterpolation(multigrid_, PETSC_TRUE));
    // Aggregates of the first two levels are two edges wide, about a hundred nodes: on one level a
    // set-up costs a third of that with narrow aggregates, and a third more iterations are needed;
    // a second level saves a quarter more and costs none (docs/notes/benchmarks.md).
    check(PCGAMGSetAggressiveLevels(multigrid_, 2));
  }

  /// The cost of the Galerkin products; the interpolation is kept (docs/linear.md).
  double set_up_cost() const override { return 8; }

private:
  void know_rigid_modes(const StiffnessLayout& layout, const Nodes& nodes) {
    Vec coordinates = nullptr;
    check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(nodes.held.size()), &coordinates));
    check(VecSetBlockSize(coordinates, nodes.dim));
    PetscScalar* place = nullptr;
    check(VecGetArray(coordinates, &place));
    for (std::size_t node = 0; node < nodes.group.size(); ++node)
      std::copy_n(layout.position[nodes.group[node]].begin(), nodes.dim, place + nodes.dim * node);
    check(VecRestoreArray(coordinates, &place));
    MatNullSpace modes = nullptr;
    check(MatNullSpaceCreateRigidBody(coordinates, &modes));
    // The modes are zero at held values.
    PetscInt count = 0;
    const Vec* vectors = nullptr;
    check(MatNullSpaceGetVecs(modes, nullptr, &count, &vectors));
    for (PetscInt k = 0; k < count; ++k) {
      check(VecGetArray(vectors[k], &place));
      for (std::size_t i = 0; i < nodes.held.size(); ++i)
        if (nodes.held[i]) place[i] = 0;
      check(VecRestoreArray(vectors[k], &place));
    }
    check(MatSetNearNullSpace(matrix_, modes));
    check(MatNullSpaceDestroy(&modes));
    check(VecDestroy(&coordinates));
  }

  void adjust() override {
    PetscInt levels = 0;
    check(PCMGGetLevels(multigrid_, &levels));
    if (levels < 2) return;
    // With a W-cycle the iterations do not grow with the number of levels; the coarser levels cost
    // little.
    check(PCMGSetCycleType(multigrid_, PC_MG_CYCLE_W));
    KSP smoother = nullptr;
    PC sweep = nullptr;
    check(PCMGGetSmoother(multigrid_, levels - 1, &smoother));
    check(KSPGetPC(smoother, &sweep));
    // On the finest level only: an aggregate of one node has fewer unknowns than there are rigid
    // modes, which leaves zero rows on the levels below. There Jacobi works, and a sweep fails.
    check(PCSetType(sweep, PCSOR));
    // With symmetric sweeps all eigenvalues are in (0, 1].
    check(KSPChebyshevSetEigenvalues(smoother, 1, 0.1));
    check(KSPSetUp(smoother));
  }
};

std::vector<int> own_numbers(const StiffnessLayout& layout) {
  std::vector<int> numbers(layout.group.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// A V-cycle with these interpolations, from the finest to the coarsest, and Galerkin products.
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
    const PetscInt *start = rows.outerIndexPtr(), *column = rows.innerIndexPtr();
    const auto count = static_cast<PetscInt>(rows.rows());
    std::vector<PetscInt> entries;
    for (PetscInt k = 0; k < count; ++k) entries.push_back(start[k + 1] - start[k]);
    Mat matrix = nullptr;
    check(MatCreateSeqAIJ(PETSC_COMM_SELF, count, static_cast<PetscInt>(rows.cols()), 0,
                          entries.data(), &matrix));
    for (PetscInt k = 0; k < count; ++k)
      check(MatSetValues(matrix, 1, &k, entries[k], column + start[k], rows.valuePtr() + start[k],
                         INSERT_VALUES));
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

}  // namespace gnomon

extern "C" gnomon::InnerSolver* gnomon_new_multigrid(
    const gnomon::StiffnessLayout& layout, const std::vector<gnomon::SparseRows>& interpolations) {
  using namespace gnomon;
  const std::scoped_lock alone(petsc_in_use);
  if (interpolations.empty()) return new AlgebraicMultigrid(layout, Nodes(layout));
  return new GeometricMultigrid(layout, interpolations);
}
