#include "newton/linear_solver.hpp"

#include <gnomon/linear/sparse_lu.hpp>

#include "newton/krylov.hpp"

namespace gnomon::sundials {

namespace {

/// The content of the SUNLinearSolver: one of the two solvers.
struct Content {
  Content(const Structure& s, Counters& c, Guard& g, SUNContext context, const LinearRequest& r)
      : counters(c), guard(g), request(r) {
    if (s.solver.method == LinearSolverChoice::Method::block)
      block = std::make_unique<BlockSolver>(s, counters, context);
    else
      lu = std::make_unique<SparseLu>(s.pattern, s.group);
  }

  void set_up(SUNMatrix J) {
    if (block) return block->set_up(values(J));
    ++counters.factorizations;
    if (!lu->factorize(values(J))) throw RecoverableError("the Jacobian is singular");
  }

  void solve(N_Vector x, N_Vector b) {
    ++counters.linear_solves;
    if (block) return block->solve(b, x, request.reduction);
    if (x != b) return lu->solve(view(b), view(x));
    const std::vector<double> right(view(b).begin(), view(b).end());  // IDA solves in place
    lu->solve(right, view(x));
  }

  Counters& counters;
  Guard& guard;
  const LinearRequest& request;
  std::unique_ptr<SparseLu> lu;
  std::unique_ptr<BlockSolver> block;
};

Content& content(SUNLinearSolver solver) {
  return *static_cast<Content*>(solver->content);
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
    Content& c = content(s);
    return c.request.keep ? 0 : c.guard.run([&] { c.set_up(J); });
  };
  solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
    Content& c = content(s);
    return c.guard.run([&] { c.solve(x, b); });
  };
  solver->ops->free = [](SUNLinearSolver s) {
    delete static_cast<Content*>(s->content);
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  LinearSolverOwner owner(solver);
  solver->content = new Content(structure, counters, guard, context, request);
  return owner;
}

}  // namespace gnomon::sundials
