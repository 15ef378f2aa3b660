// The choice of linear solvers of a problem.
#pragma once

namespace gnomon {

/// How the linear systems of Newton's method are solved.
struct LinearSolverChoice {
  enum class Method {
    direct,  ///< sparse LU of the whole Jacobian
    block    ///< flexible GMRES on it, preconditioned by blocks (linear/block_preconditioner.hpp)
  };
  enum class Preconditioner {
    factor,    ///< sparse Cholesky factors of the stiffness blocks
    multigrid  ///< along the grid lines of the mesh, or smoothed aggregation
  };
  Method method = Method::direct;
  Preconditioner preconditioner = Preconditioner::factor;  ///< used by `block`
  /// Whether factors of the whole Jacobian solve a system with which `block` fails, as where the
  /// stiffness is not positive definite. In the plane they are affordable.
  bool direct_at_failure = false;

  bool uses_factors() const {
    return method == Method::direct || preconditioner == Preconditioner::factor;
  }
};

}  // namespace gnomon
