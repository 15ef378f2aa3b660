// Sparse LU by KLU with a given order of elimination, with the interface of SparseLu.
#pragma once

#include <klu.h>

#include <gnomon/fields/sparse_pattern.hpp>
#include <span>
#include <vector>

namespace gnomon::bench {

/// Uses the exact pattern: KLU has no dense fronts that would benefit from padding.
class Klu {
public:
  /// `order`: entry k is the unknown eliminated k-th, as nested_dissection() gives it.
  Klu(const SparsePattern& pattern, const std::vector<int>& order);
  ~Klu();
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  /// With a search for pivots, the diagonal preferred.
  bool factorize(std::span<const double> values);
  /// With the pivots of the last factorize(): KLU's fastest, but unsafe once a contact node
  /// switches.
  bool refactorize(std::span<const double> values);
  void solve(std::span<const double> b, std::span<double> x);

  double factor_nonzeros() const { return double(numeric_->lnz) + double(numeric_->unz); }
  double factor_flops();

private:
  SparsePattern pattern_;
  klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace gnomon::bench
