#include "linear/dense_products.hpp"

extern "C" {
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
            const double* alpha, const double* A, const int* lda, const double* B, const int* ldb,
            const double* beta, double* C, const int* ldc);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
            const int* n, const double* alpha, const double* A, const int* lda, double* B,
            const int* ldb);
}

namespace gnomon {

void subtract_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C) {
  if (A.size() == 0 || B.size() == 0) return;
  const int m = int(A.rows()), n = int(B.cols()), k = int(A.cols());
  const double minus = -1, one = 1;
  dgemm_("N", "N", &m, &n, &k, &minus, A.data(), &m, B.data(), &k, &one, C.data(), &m);
}

Eigen::MatrixXd solve(const Eigen::PartialPivLU<Eigen::MatrixXd>& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd X = A.permutationP() * B;
  if (X.size() == 0) return X;
  const int m = int(X.rows()), n = int(X.cols());
  const double one = 1, *LU = A.matrixLU().data();
  dtrsm_("L", "L", "N", "U", &m, &n, &one, LU, &m, X.data(), &m);
  dtrsm_("L", "U", "N", "N", &m, &n, &one, LU, &m, X.data(), &m);
  return X;
}

}  // namespace gnomon
