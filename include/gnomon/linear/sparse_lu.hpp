// Sparse LU by UMFPACK, ordered by nested dissection (METIS) of the graph of groups.
#pragma once

#include <gnomon/fields/sparse_pattern.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// Order of elimination: METIS on the graph of groups (mesh nodes), where members of a group stay
/// together in ascending order. Entry k is the unknown eliminated k-th.
std::vector<int> nested_dissection(const SparsePattern& pattern, const std::vector<int>& group);

/// LU factors of matrices that share one pattern: analysed once, factorized often.
class SparseLu {
public:
  /// Unknowns of one `group` (mesh node) are eliminated together.
  SparseLu(const SparsePattern& pattern, const std::vector<int>& group);
  ~SparseLu();
  SparseLu(const SparseLu&) = delete;
  SparseLu& operator=(const SparseLu&) = delete;

  /// Factorizes `values` on the pattern. Returns false when the matrix is singular or not finite.
  bool factorize(std::span<const double> values);
  /// Solves J x = b with the last factors.
  void solve(std::span<const double> b, std::span<double> x) const;

  /// Entries of L and U together, of the last factorization.
  double factor_nonzeros() const;
  /// Floating-point operations of the last factorization.
  double factor_flops() const;

private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace gnomon
