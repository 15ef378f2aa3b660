#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <numeric>

#include "linear/blas.hpp"
#include "linear/rounded_factor.hpp"

namespace gnomon {

namespace {

/// CHOLMOD's workspace and settings. 64-bit indices: a factor may have more than 2^31 entries.
struct Common {
  cholmod_common data;
  Common() {
    cholmod_l_start(&data);
    data.itype = CHOLMOD_LONG;
    data.supernodal = CHOLMOD_SUPERNODAL;
    data.nmethods = 1;
    data.method[0].ordering = CHOLMOD_GIVEN;
    data.postorder = 1;
    data.quick_return_if_not_posdef = 1;
    data.print = 0;
  }
  ~Common() { cholmod_l_finish(&data); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
};

/// The memory that solves need in addition to the factor, kept for the next solve; each thread has
/// its own.
struct Workspace {
  Common common;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
  Workspace() = default;
  ~Workspace() {
    cholmod_l_free_dense(&x, &common.data);
    cholmod_l_free_dense(&y, &common.data);
    cholmod_l_free_dense(&e, &common.data);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
};

/// A symmetric matrix of which the lower triangle is used.
cholmod_sparse symmetric(std::size_t size, const std::vector<SuiteSparse_long>& start,
                         const std::vector<SuiteSparse_long>& row) {
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = size;
  matrix.nzmax = row.size();
  matrix.p = const_cast<SuiteSparse_long*>(start.data());
  matrix.i = const_cast<SuiteSparse_long*>(row.data());
  matrix.stype = -1;
  matrix.itype = CHOLMOD_LONG;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  return matrix;
}

constexpr double worth_threads = 1e10;  // operations; below, waking threads costs more

class FactorSolver : public InnerSolver {
public:
  FactorSolver(const StiffnessLayout& layout, const FactorSizes& sizes)
      : layout_(layout),
        sizes_(sizes),
        start_(layout.lower.column_start.begin(), layout.lower.column_start.end()),
        row_(layout.lower.row_index.begin(), layout.lower.row_index.end()),
        values_(row_.size(), 1.0) {
    use_blas_threads(1);
    for (int j = 0; j < layout.lower.size(); ++j) diagonal_.push_back(layout.lower.find(j, j));
    const std::vector<int> order = nested_dissection(layout.lower, layout.group);
    std::vector<SuiteSparse_long> permutation(order.begin(), order.end());
    cholmod_sparse matrix = view();
    factor_ = cholmod_l_analyze_p(&matrix, permutation.data(), nullptr, 0, &common_.data);
    if (!factor_)
      throw Error("CHOLMOD could not analyse a matrix of " + std::to_string(layout.lower.size()) +
                  " unknowns");
  }

  ~FactorSolver() override { cholmod_l_free_factor(&factor_, &common_.data); }

  bool set_up(std::span<const double> values) override {
    factorizations_ = 0;
    for (const double stiffer : {0.0, 0.01, 0.1, 1.0}) {
      std::copy(values.begin(), values.end(), values_.begin());
      for (SuiteSparse_long k : diagonal_) values_[k] += stiffer * std::abs(values_[k]);
      if (!factorize()) continue;
      if (common_.data.lnz >= sizes_.rounded) rounded_.copy(*factor_);
      return true;
    }
    return false;
  }

  void apply(std::span<const double> b, std::span<double> x) override {
    // CHOLMOD copies the columns; its dense kernels are as efficient with a few columns as with
    // all.
    constexpr long most = 32;
    const long size = layout_.lower.size(), count = static_cast<long>(b.size()) / size;
    if (count == 1 && !rounded_.empty()) return rounded_.solve(b, x);
    const double operations = 4 * common_.data.lnz * static_cast<double>(count);
    const long threads =
        operations > sizes_.threads ? std::min<long>(count, omp_get_max_threads()) : 1;
    while (static_cast<long>(workspaces_.size()) < threads) workspaces_.emplace_back();
    const long part = std::min(most, (count + threads - 1) / threads);
    bool solved = true;
#pragma omp parallel for num_threads(static_cast <int>(threads)) reduction(&& : solved)
    for (long start = 0; start < count; start += part) {
      const long entries = std::min(part, count - start) * size;
      solved = solve(workspaces_[omp_get_thread_num()], b.subspan(start * size, entries),
                     x.subspan(start * size, entries)) &&
               solved;
    }
    if (!solved) throw Error("CHOLMOD could not solve");
  }

  int factorizations() const override {
    return factorizations_;
  }
  double set_up_cost() const override {
    // Dense kernels of a factorization do about 5 operations in the time of one operation of a
    // solve, which waits for memory (191,100 unknowns, 4.5e11 operations, 1.9e8 entries: 12 s by
    // two threads against 0.155 s, in double precision and with CHOLMOD's own threads on).
    constexpr double faster = 5;
    return common_.data.fl / (4 * common_.data.lnz * faster);
  }

private:
  cholmod_sparse view() const {
    cholmod_sparse matrix = symmetric(static_cast<std::size_t>(layout_.lower.size()), start_, row_);
    matrix.x = const_cast<double*>(values_.data());
    matrix.xtype = CHOLMOD_REAL;
    return matrix;
  }

  /// Returns false where the matrix is not positive definite.
  bool factorize() {
    cholmod_sparse matrix = view();
    ++factorizations_;
    if (common_.data.fl > worth_threads) use_blas_threads(omp_get_max_threads());
    // CHOLMOD uses four threads for its small loops on every number of cores; on two cores they
    // wait for each other for as long as all other work takes.
    const int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    cholmod_l_factorize(&matrix, factor_, &common_.data);
    omp_set_max_active_levels(levels);
    use_blas_threads(1);
    if (common_.data.status == CHOLMOD_OUT_OF_MEMORY || common_.data.status == CHOLMOD_TOO_LARGE)
      throw Error("out of memory while factorizing a matrix of " +
                  std::to_string(layout_.lower.size()) + " unknowns");
    return common_.data.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  cholmod_dense columns(std::span<const double> values) const {
    cholmod_dense dense{};
    dense.nrow = dense.d = static_cast<std::size_t>(layout_.lower.size());
    dense.nzmax = values.size();
    dense.ncol = values.size() / dense.nrow;
    dense.x = const_cast<double*>(values.data());
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    return dense;
  }
  bool solve(Workspace& workspace, std::span<const double> b, std::span<double> x) const {
    auto& [common, result, y, e] = workspace;
    cholmod_dense right = columns(b);
    cholmod_l_solve2(CHOLMOD_A, factor_, &right, nullptr, &result, nullptr, &y, &e, &common.data);
    if (common.data.status != CHOLMOD_OK) return false;
    std::copy_n(static_cast<const double*>(result->x), x.size(), x.begin());
    return true;
  }

  const StiffnessLayout& layout_;
  const FactorSizes sizes_;
  Common common_;
  std::vector<SuiteSparse_long> start_, row_;
  std::vector<double> values_;
  cholmod_factor* factor_ = nullptr;
  RoundedFactor rounded_;                   // empty where the factors are small
  std::deque<Workspace> workspaces_;        // one per thread
  std::vector<SuiteSparse_long> diagonal_;  // positions in values_
  int factorizations_ = 0;
};

}  // namespace

std::unique_ptr<InnerSolver> make_factor_solver(const StiffnessLayout& layout,
                                                const FactorSizes& sizes) {
  return std::make_unique<FactorSolver>(layout, sizes);
}

InnerSolverMaker factor_solvers() {
  return {[](const StiffnessLayout& layout) { return make_factor_solver(layout); }, 0.25};
}

double factor_entries(const SparsePattern& pattern) {
  if (pattern.size() == 0) return 0;
  std::vector<int> group(pattern.size());
  std::iota(group.begin(), group.end(), 0);
  const std::vector<int> order = nested_dissection(pattern, group);
  std::vector<SuiteSparse_long> permutation(order.begin(), order.end());
  const std::vector<SuiteSparse_long> start(pattern.column_start.begin(),
                                            pattern.column_start.end()),
      row(pattern.row_index.begin(), pattern.row_index.end());
  cholmod_sparse matrix = symmetric(static_cast<std::size_t>(pattern.size()), start, row);
  Common common;
  common.data.supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_factor* factor =
      cholmod_l_analyze_p(&matrix, permutation.data(), nullptr, 0, &common.data);
  if (!factor)
    throw Error("CHOLMOD could not analyse a matrix of " + std::to_string(pattern.size()) +
                " unknowns");
  cholmod_l_free_factor(&factor, &common.data);
  return common.data.lnz;
}

}  // namespace gnomon
