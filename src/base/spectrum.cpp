#include "base/spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace gnomon {

Spectrum spectrum_of(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& symmetric, double least) {
  const auto [values, vectors] = spectrum_of(symmetric);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(symmetric.rows(), symmetric.cols());
  for (Eigen::Index k = 0; k < values.size(); ++k)
    if (values[k] > least * values.cwiseAbs().maxCoeff())
      inverse += vectors.col(k) * vectors.col(k).transpose() / values[k];
  return inverse;
}

}  // namespace gnomon
