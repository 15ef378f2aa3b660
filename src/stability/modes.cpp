#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
// GCC 12 warns that a temporary in Spectra's Hessenberg solver was freed (a false alarm).
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif
#include <Spectra/GenEigsSolver.h>

#include <gnomon/base/error.hpp>
#include <gnomon/stability/stability.hpp>

namespace gnomon {

namespace {

/// The interface that Spectra requires of a matrix.
class Operation {
public:
  using Scalar = double;
  explicit Operation(const ReducedJacobian& G) : G_(G) {}
  Eigen::Index rows() const { return G_.size(); }
  Eigen::Index cols() const { return G_.size(); }
  void perform_op(const double* v, double* Gv) const {
    const auto n = static_cast<std::size_t>(G_.size());
    G_.multiply({v, n}, {Gv, n});
  }

private:
  const ReducedJacobian& G_;
};

/// Where nothing wears, G = 0 and the Arnoldi iteration has no second direction. A vector without
/// symmetry shows it.
bool is_zero(const ReducedJacobian& G) {
  Eigen::VectorXd v(G.size()), Gv(G.size());
  for (int i = 0; i < G.size(); ++i) v[i] = 1 + std::sin(i);
  const auto n = static_cast<std::size_t>(G.size());
  G.multiply({v.data(), n}, {Gv.data(), n});
  return Gv.isZero(0);
}

template <class Values, class Vectors>
std::vector<Mode> sorted_modes(const Values& values, const Vectors& vectors) {
  std::vector<Mode> modes;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    modes.push_back({values[k], vectors.col(k).normalized()});
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    return std::abs(a.eigenvalue) > std::abs(b.eigenvalue);
  });
  return modes;
}

}  // namespace

std::vector<Mode> all_modes(const Eigen::MatrixXd& G) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(G);
  if (solver.info() != Eigen::Success) throw SolutionError("the QR algorithm does not converge");
  return sorted_modes(solver.eigenvalues(), solver.eigenvectors());
}

std::vector<Mode> leading_modes(const ReducedJacobian& G, int count) {
  const int basis = std::max(4 * count, 20);  // vectors kept between restarts
  if (basis >= G.size()) {
    std::vector<Mode> modes = all_modes(G.dense());
    modes.resize(std::min<std::size_t>(modes.size(), count));
    return modes;
  }
  if (is_zero(G)) return {};
  Operation operation(G);
  Spectra::GenEigsSolver<Operation> solver(operation, count, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-9);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw SolutionError("the Arnoldi iteration for the largest eigenvalues does not converge");
  return sorted_modes(solver.eigenvalues(), solver.eigenvectors());
}

}  // namespace gnomon
