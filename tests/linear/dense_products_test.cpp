// Dense products by BLAS are those of Eigen.

#include "linear/dense_products.hpp"

#include <gtest/gtest.h>

namespace gnomon::dense_products_test {
namespace {

using Eigen::MatrixXd;

TEST(DenseProducts, AreThoseOfEigen) {
  std::srand(1);
  const MatrixXd A = MatrixXd::Random(7, 5), B = MatrixXd::Random(5, 3), C = MatrixXd::Random(7, 3);
  MatrixXd rest = C;
  subtract_product(A, B, rest);
  EXPECT_LT((rest - (C - A * B)).norm(), 1e-14);
  const MatrixXd K = MatrixXd::Random(7, 7);
  const Eigen::PartialPivLU<MatrixXd> lu(K);
  EXPECT_LT((K * gnomon::solve(lu, C) - C).norm(), 1e-12);
}

TEST(DenseProducts, MayHaveNothing) {
  MatrixXd none(0, 3), C = MatrixXd::Ones(2, 3);
  subtract_product(MatrixXd(2, 0), none, C);
  EXPECT_EQ(C, MatrixXd::Ones(2, 3));
  const Eigen::PartialPivLU<MatrixXd> lu(MatrixXd::Identity(2, 2));
  EXPECT_EQ(gnomon::solve(lu, MatrixXd(2, 0)).size(), 0);
}

}  // namespace
}  // namespace gnomon::dense_products_test
