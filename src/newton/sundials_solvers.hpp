// What SUNDIALS solves with: LinearSolver as a SUNLinearSolver, and semismooth Newton by
// NewtonPolicy as a SUNNonlinearSolver.
#pragma once

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/newton/newton_options.hpp>
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

using NonlinearSolverOwner = Owner<_generic_SUNNonlinearSolver, SUNNonlinSolFree>;

/// IDA's own Newton freezes the Jacobian within a step and gives up after four iterations, which
/// fails whenever a contact node switches. This solver makes factors when IDA or the policy demands
/// them. `state_at`: the state at a correction `ycor` of the predicted one, valid until the next
/// call; `branch_at`: the smooth branch at a state.
/// `differential`: 1 where a component takes part in the error norm of IDA, else 0.
/// It passes its requests to the linear solver through `request`, and forgets the slow part of the
/// Jacobian, `slow`, when the iteration needs a new one. The referenced objects must outlive the
/// solver.
NonlinearSolverOwner make_semismooth_newton(const Structure& structure, Counters& counters,
                                            Guard& guard, const NewtonOptions& options,
                                            std::function<Point(N_Vector ycor)> state_at,
                                            std::function<ActiveSet(const Point&)> branch_at,
                                            N_Vector differential, LinearRequest& request,
                                            SlowPart& slow, SUNContext context);

/// Gives a solver that IDA uses what another one holds, but for the functions of IDA.
void replace_content(SUNNonlinearSolver in_use, NonlinearSolverOwner by);

}  // namespace gnomon::sundials
