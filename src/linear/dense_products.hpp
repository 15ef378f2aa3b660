// Products and solves of large dense matrices by BLAS: its kernels are chosen for the processor at
// run time and take a fraction of the time of Eigen's, which are compiled for any of its kind.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace gnomon {

/// C -= A B.
void subtract_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C);

/// A^-1 B.
Eigen::MatrixXd solve(const Eigen::PartialPivLU<Eigen::MatrixXd>& A, const Eigen::MatrixXd& B);

}  // namespace gnomon
