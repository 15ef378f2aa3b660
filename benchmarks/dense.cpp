#include "dense.hpp"

#include <random>

extern "C" {
void dgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const double* alpha, const double* a, const int* lda, const double* b,
            const int* ldb, const double* beta, double* c, const int* ldc);
// Not every BLAS has these two; resolved when the program is loaded.
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info)
    __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace gnomon::bench {

Dense::Dense() : a_(static_cast<std::size_t>(order) * order), b_(a_), c_(a_), pivots_(order) {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& entry : a_) entry = uniform(generator);
  for (double& entry : b_) entry = uniform(generator);
}

void Dense::product() {
  const int n = order;
  const double one = 1, zero = 0;
  dgemm_("N", "N", &n, &n, &n, &one, a_.data(), &n, b_.data(), &n, &zero, c_.data(), &n);
}

void Dense::factorize() {
  const int n = order;
  int info = 0;
  c_ = a_;
  dgetrf_(&n, &n, c_.data(), &n, pivots_.data(), &info);
}

bool Dense::has_factorization() {
  return dgetrf_ != nullptr;
}

}  // namespace gnomon::bench
