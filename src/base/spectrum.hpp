// Decompositions of small symmetric matrices, compiled once: Eigen's templates take seconds
// wherever they are made.
#pragma once

#include <Eigen/Core>

namespace gnomon {

/// Eigenvalues, ascending, and the eigenvectors of unit length in the columns.
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Spectrum spectrum_of(const Eigen::MatrixXd& symmetric);

/// The inverse on the eigenvectors whose values are at least `least` of the largest; zero on the
/// others.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& symmetric, double least = 1e-12);

}  // namespace gnomon
