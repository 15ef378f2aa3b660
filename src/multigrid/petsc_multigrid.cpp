// The only module that uses PETSc. src/linear/multigrid.cpp loads it on first use.

#include <petscksp.h>

#include <algorithm>
#include <cstdlib>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <string>

namespace gnomon {

namespace {

void check(PetscErrorCode code) {
  if (code) throw Error("PETSc failed with code " + std::to_string(code));
}

/// Called once per process; PETSc does not change signals, standard streams or the user's settings.
void initialize_petsc() {
  PetscBool initialized = PETSC_FALSE;
  check(PetscInitialized(&initialized));
  if (initialized) return;
  // There is only one process: without these settings OpenMPI searches for networks, which is slow,
  // and prints which ones are missing.
  setenv("OMPI_MCA_btl", "self", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_opal_signal", "", 0);  // the program handles signals itself
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
  check(PetscOptionsSetValue(nullptr, "-skip_petscrc", "true"));
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  std::atexit([] { PetscFinalize(); });
}

/// Every node with all its components, including those that are held: numbers dim * node +
/// component.
struct Nodes {
  int dim = 1;
  std::vector<int> group;   // of each node
  std::vector<int> number;  // of each unknown
  std::vector<char> held;   // of each number

  explicit Nodes(const StiffnessLayout& layout) {
    for (char component : layout.component) dim = std::max(dim, component + 1);
    std::vector<int> node_of(layout.position.size(), -1);
    for (std::size_t k = 0; k < layout.group.size(); ++k) {
      int& node = node_of[layout.group[k]];
      if (node < 0) {
        node = static_cast<int>(group.size());
        group.push_back(layout.group[k]);
      }
      number.push_back(dim * node + layout.component[k]);
    }
    held.assign(dim * group.size(), 1);
    for (int n : number) held[n] = 0;
  }
  PetscInt size() const { return static_cast<PetscInt>(held.size()); }
};

class PetscMultigrid : public InnerSolver {
public:
  explicit PetscMultigrid(const StiffnessLayout& layout);
  ~PetscMultigrid() override;

  bool set_up(std::span<const double> values) override;
  void apply(std::span<const double> b, std::span<double> x) override;
  int factorizations() const override { return 0; }
  /// The cost of the Galerkin products; the interpolation is kept (docs/benchmarks.md).
  double set_up_cost() const override { return 8; }

private:
  void build_pattern(const StiffnessLayout& layout);
  void make_preconditioner();
  void know_rigid_modes(const StiffnessLayout& layout);
  void choose_cycle();
  void apply_to_one(std::span<const double> b, std::span<double> x);

  Nodes nodes_;
  std::vector<PetscInt> start_, column_;
  std::vector<PetscInt> source_;  // in the values on `lower`; -1: held
  std::vector<PetscScalar> values_;
  Mat matrix_ = nullptr;
  PC multigrid_ = nullptr;
  Vec right_ = nullptr, solution_ = nullptr;
};

PetscMultigrid::PetscMultigrid(const StiffnessLayout& layout)
    : nodes_((initialize_petsc(), layout)) {
  build_pattern(layout);
  const PetscInt n = nodes_.size();
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, start_.data(), column_.data(),
                                  values_.data(), &matrix_));
  check(MatSetBlockSize(matrix_, nodes_.dim));
  check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  check(MatCreateVecs(matrix_, &solution_, &right_));
  know_rigid_modes(layout);
  make_preconditioner();
}

PetscMultigrid::~PetscMultigrid() {
  PetscBool over = PETSC_FALSE;
  PetscFinalized(&over);
  if (over) return;
  PCDestroy(&multigrid_);
  MatDestroy(&matrix_);
  VecDestroy(&right_);
  VecDestroy(&solution_);
}

void PetscMultigrid::build_pattern(const StiffnessLayout& layout) {
  struct Entry {
    PetscInt column, source;
  };
  std::vector<std::vector<Entry>> rows(nodes_.held.size());
  const SparsePattern& lower = layout.lower;
  for (int j = 0; j < lower.size(); ++j)
    for (int k = lower.column_start[j]; k < lower.column_start[j + 1]; ++k) {
      const int row = nodes_.number[lower.row_index[k]], column = nodes_.number[j];
      rows[row].push_back({column, k});
      if (row != column) rows[column].push_back({row, k});
    }
  start_.push_back(0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (nodes_.held[i]) rows[i].push_back({static_cast<PetscInt>(i), -1});
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

void PetscMultigrid::make_preconditioner() {
  check(PCCreate(PETSC_COMM_SELF, &multigrid_));
  check(PCSetOperators(multigrid_, matrix_, matrix_));
  check(PCSetType(multigrid_, PCGAMG));
  check(PCGAMGSetReuseInterpolation(multigrid_, PETSC_TRUE));
  // Aggregates of the first level are two edges wide, about a hundred nodes: a set-up costs a third
  // of that with narrow aggregates, and a third more iterations are needed.
  check(PCGAMGSetAggressiveLevels(multigrid_, 1));
}

void PetscMultigrid::know_rigid_modes(const StiffnessLayout& layout) {
  Vec coordinates = nullptr;
  check(VecCreateSeq(PETSC_COMM_SELF, nodes_.size(), &coordinates));
  check(VecSetBlockSize(coordinates, nodes_.dim));
  PetscScalar* place = nullptr;
  check(VecGetArray(coordinates, &place));
  for (std::size_t node = 0; node < nodes_.group.size(); ++node)
    std::copy_n(layout.position[nodes_.group[node]].begin(), nodes_.dim, place + nodes_.dim * node);
  check(VecRestoreArray(coordinates, &place));
  MatNullSpace modes = nullptr;
  check(MatNullSpaceCreateRigidBody(coordinates, &modes));
  // The modes are zero at held values.
  PetscInt count = 0;
  const Vec* vectors = nullptr;
  check(MatNullSpaceGetVecs(modes, nullptr, &count, &vectors));
  for (PetscInt k = 0; k < count; ++k) {
    check(VecGetArray(vectors[k], &place));
    for (std::size_t i = 0; i < nodes_.held.size(); ++i)
      if (nodes_.held[i]) place[i] = 0;
    check(VecRestoreArray(vectors[k], &place));
  }
  check(MatSetNearNullSpace(matrix_, modes));
  check(MatNullSpaceDestroy(&modes));
  check(VecDestroy(&coordinates));
}

bool PetscMultigrid::set_up(std::span<const double> values) {
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
  choose_cycle();
  PCFailedReason failed = PC_NOERROR;
  check(PCGetFailedReason(multigrid_, &failed));
  return failed == PC_NOERROR;
}

/// The levels exist only after a set-up.
void PetscMultigrid::choose_cycle() {
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

void PetscMultigrid::apply(std::span<const double> b, std::span<double> x) {
  const std::size_t size = nodes_.number.size();
  for (std::size_t start = 0; start < b.size(); start += size)
    apply_to_one(b.subspan(start, size), x.subspan(start, size));
}

void PetscMultigrid::apply_to_one(std::span<const double> b, std::span<double> x) {
  PetscScalar* right = nullptr;
  check(VecGetArrayWrite(right_, &right));
  std::fill_n(right, nodes_.held.size(), 0.0);
  for (std::size_t k = 0; k < b.size(); ++k) right[nodes_.number[k]] = b[k];
  check(VecRestoreArrayWrite(right_, &right));
  check(PCApply(multigrid_, right_, solution_));
  const PetscScalar* solution = nullptr;
  check(VecGetArrayRead(solution_, &solution));
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = solution[nodes_.number[k]];
  check(VecRestoreArrayRead(solution_, &solution));
}

}  // namespace

}  // namespace gnomon

extern "C" gnomon::InnerSolver* gnomon_new_multigrid(const gnomon::StiffnessLayout& layout) {
  return new gnomon::PetscMultigrid(layout);
}
