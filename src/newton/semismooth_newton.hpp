// A SUNNonlinearSolver for IDA: semismooth Newton that keeps its factor while it contracts well.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <functional>
#include <gnomon/newton/newton.hpp>

#include "newton/linear_solver.hpp"

namespace gnomon::sundials {

inline void destroy_nonlinear(_generic_SUNNonlinearSolver* s) {
  SUNNonlinSolFree(s);
}
using NonlinearSolverOwner = Owner<_generic_SUNNonlinearSolver, destroy_nonlinear>;

/// IDA's own Newton freezes the Jacobian within a step and gives up after four iterations, which
/// fails whenever a contact node switches. This one refactors when IDA asks, when the active set is
/// no longer that of the factor, and when an iteration contracts by less than `slow`; it ends when
/// the scaled residual is below the tolerance of every gnomon solve.
struct SemismoothSettings {
  NewtonOptions newton;
  double slow = 0.2;
  /// The active set at a correction `ycor` of the predicted state.
  std::function<void(N_Vector ycor, std::vector<char>& active)> active_set;
};

/// Tells the linear solver through `request` what it needs. References must outlive the solver.
NonlinearSolverOwner make_semismooth_newton(const Structure& structure, Counters& counters,
                                            Guard& guard, const SemismoothSettings& settings,
                                            LinearRequest& request, SUNContext context);

}  // namespace gnomon::sundials
