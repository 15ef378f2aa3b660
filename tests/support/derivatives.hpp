// Helpers for derivative tests: central differences and automatic differentiation of a residual
// that is a template on its scalar, and a comparison that fails for a zero matrix.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <unsupported/Eigen/AutoDiff>

namespace gnomon::testing {

using Dual = Eigen::AutoDiffScalar<Eigen::VectorXd>;

/// `values` as independent variables number first, first + 1, ... of `total`.
template <class Number = Dual, class Matrix>
auto independent(const Matrix& values, int first, int total) {
  using Result = Eigen::Matrix<Number, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime, 0,
                               Matrix::MaxRowsAtCompileTime, Matrix::MaxColsAtCompileTime>;
  Result result(values.rows(), values.cols());
  // Row by row, as unknowns are numbered: dim * node + component.
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      result(i, j) = Number(values(i, j), total, static_cast<int>(first + i * values.cols() + j));
  return result;
}

/// The same values as constants.
template <class Matrix>
auto constant(const Matrix& values, int total) {
  using Result = Eigen::Matrix<Dual, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime, 0,
                               Matrix::MaxRowsAtCompileTime, Matrix::MaxColsAtCompileTime>;
  Result result(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      result(i, j) = Dual(values(i, j));
      result(i, j).derivatives() = Eigen::VectorXd::Zero(total);
    }
  return result;
}

/// Derivatives of every entry (row by row) of a matrix of Duals.
template <class Matrix>
Eigen::MatrixXd derivative_matrix(const Matrix& R, int total) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(R.size(), total);
  for (Eigen::Index i = 0; i < R.rows(); ++i)
    for (Eigen::Index j = 0; j < R.cols(); ++j)
      if (R(i, j).derivatives().size() > 0)
        K.row(i * R.cols() + j) = R(i, j).derivatives().transpose();
  return K;
}

/// Expects relative agreement in the largest entry; fails for a zero reference.
inline void expect_same_matrix(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected,
                               double tolerance) {
  ASSERT_EQ(actual.rows(), expected.rows());
  ASSERT_EQ(actual.cols(), expected.cols());
  const double size = expected.cwiseAbs().maxCoeff();
  ASSERT_GT(size, 0) << "the reference derivative is zero: the comparison would be vacuous";
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance * size);
}

/// Reproducible noise of the given amplitude.
template <class Matrix>
Matrix noise(double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  Matrix result;
  for (Eigen::Index k = 0; k < result.size(); ++k) result.data()[k] = uniform(generator);
  return result;
}

}  // namespace gnomon::testing
