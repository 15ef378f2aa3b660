#include "newton/sun_linear_solver.hpp"

#include <gnomon/newton/linear_solver_kind.hpp>

namespace gnomon::sundials {

namespace {

struct LinearContent {
  std::unique_ptr<LinearSolver> linear;
  Counters& counters;
  Guard& guard;
  const LinearRequest& request;
};

LinearContent& content(SUNLinearSolver solver) {
  return *static_cast<LinearContent*>(solver->content);
}

}  // namespace

LinearSolverOwner make_linear_solver(const Structure& structure, Counters& counters, Guard& guard,
                                     SUNContext context, const LinearRequest& request) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  check(solver, "SUNLinSolNewEmpty");
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->initialize = [](SUNLinearSolver) { return 0; };
  solver->ops->setup = [](SUNLinearSolver s, SUNMatrix J) {
    LinearContent& c = content(s);
    return c.request.keep ? 0 : c.guard.run([&] { c.linear->set_up(values(J)); });
  };
  solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
    LinearContent& c = content(s);
    ++c.counters.linear_solves;
    return c.guard.run([&] { c.linear->solve(view(b), view(x), c.request.reduction); });
  };
  solver->ops->free = [](SUNLinearSolver s) {
    delete static_cast<LinearContent*>(s->content);
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  LinearSolverOwner owner(solver);
  solver->content =
      new LinearContent{gnomon::make_linear_solver(structure, counters), counters, guard, request};
  return owner;
}

}  // namespace gnomon::sundials
