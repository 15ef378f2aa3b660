// LinearSolver as a SUNLinearSolver.
#pragma once

#include <sundials/sundials_linearsolver.h>

#include <gnomon/base/counters.hpp>
#include <gnomon/system/system.hpp>

#include "sundials/room.hpp"

namespace gnomon::sundials {

using LinearSolverOwner = Owner<_generic_SUNLinearSolver, SUNLinSolFree>;

/// The request of a nonlinear solver to its linear solver, set before every solve.
struct LinearRequest {
  bool keep = false;        ///< a set-up leaves the last Jacobian and factors as they are
  double reduction = 1e-8;  ///< residual to be reached, relative to the right side; direct: ignored
};

/// For SUNDIALS it is a direct solver, so that Jacobians are passed as matrices and gnomon chooses
/// the tolerances. The referenced objects must outlive it.
LinearSolverOwner make_linear_solver(const Structure& structure, Counters& counters, Guard& guard,
                                     SUNContext context, const LinearRequest& request);

}  // namespace gnomon::sundials
