// The counters by their names, as files and tables have them.
#pragma once

#include <gnomon/base/counters.hpp>

namespace gnomon {

struct NamedCounter {
  const char* name;
  long Counters::*value;
  const char* meaning;
};

inline constexpr NamedCounter named_counters[] = {
    {"steps", &Counters::steps, "accepted steps"},
    {"rejected_steps", &Counters::rejected_steps,
     "rejected attempts of steps: error test, or nonlinear solve failed"},
    {"events", &Counters::events, "located changes of the active set"},
    {"newton_iterations", &Counters::newton_iterations, "iterations of Newton's method"},
    {"residual_evaluations", &Counters::residual_evaluations, "evaluations of the residual"},
    {"jacobian_evaluations", &Counters::jacobian_evaluations, "evaluations of the Jacobian"},
    {"factorizations", &Counters::factorizations, "numeric factorizations"},
    {"linear_solves", &Counters::linear_solves, "solves with the Jacobian"},
    {"krylov_iterations", &Counters::krylov_iterations, "iterations of the block solver"},
    {"preconditioner_setups", &Counters::preconditioner_setups,
     "set-ups of the block solver, by factors or multigrid"}};

}  // namespace gnomon
