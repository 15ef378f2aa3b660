// Dense BLAS and LAPACK on one thread: the limit that a sparse factorization is measured against.
#pragma once

#include <vector>

namespace gnomon::bench {

/// One product and one LU factorization of random matrices. Their order is that of the largest
/// front at 160x160: four unknowns on each of 160 nodes of the last separator.
class Dense {
public:
  static constexpr int order = 640;
  static constexpr double product_flops = 2.0 * order * order * order;
  static constexpr double factorization_flops = 2.0 / 3 * order * order * order;

  Dense();
  /// C = A B by dgemm.
  void product();
  /// Copies A and factorizes the copy by dgetrf.
  void factorize();
  /// Whether the BLAS in use contains LAPACK, as OpenBLAS does.
  static bool has_factorization();

private:
  std::vector<double> a_, b_, c_;
  std::vector<int> pivots_;
};

}  // namespace gnomon::bench
