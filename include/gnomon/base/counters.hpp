// Work counted over a whole run. Every solver adds to the same counters with the same meaning.
#pragma once

#include <limits>

namespace gnomon {

struct Counters {
  long steps = 0;           ///< accepted steps
  long rejected_steps = 0;  ///< rejected attempts: error test, or nonlinear solve failed
  long events = 0;          ///< located changes of the active set on which a step was ended
  long newton_iterations = 0;
  long residual_evaluations = 0;
  long jacobian_evaluations = 0;
  long factorizations = 0;         ///< numeric factorizations
  long linear_solves = 0;          ///< solves with the Jacobian
  long krylov_iterations = 0;      ///< of the block solver
  long preconditioner_setups = 0;  ///< of the block solver, by factors or multigrid
  /// A run that needs more fails.
  long most_newton_iterations = std::numeric_limits<long>::max();
};

}  // namespace gnomon
