#include "newton/semismooth_newton.hpp"

#include "newton/forcing.hpp"

namespace gnomon::sundials {

namespace {

struct Content {
  const Structure& structure;
  Counters& counters;
  Guard& guard;
  SemismoothSettings settings;
  LinearRequest& request;
  VectorOwner delta;
  SUNNonlinSolSysFn residual = nullptr;
  SUNNonlinSolLSetupFn setup = nullptr;
  SUNNonlinSolLSolveFn solve = nullptr;
  std::vector<char> factored_set{}, current_set{};  // active sets of the factor and of the iterate
  long iterations = 0;                              // of the last solve
  long failures = 0;

  int iterate(N_Vector ycor, bool call_setup, void* ida);
  int refactor(void* ida, bool converging);
  double norm() { return scaled_norm(view(delta.get()), structure.row_scale); }
};

Content& content(SUNNonlinearSolver solver) {
  return *static_cast<Content*>(solver->content);
}

int Content::refactor(void* ida, bool converging) {
  int current = 0;
  const int flag = setup(converging ? SUNFALSE : SUNTRUE, &current, ida);
  factored_set = current_set;
  return flag;
}

// Positive: recoverable, IDA cuts the step. Negative: fatal.
int Content::iterate(N_Vector ycor, bool call_setup, void* ida) {
  iterations = 0;
  double previous = 0;
  for (;;) {
    if (const int flag = residual(ycor, delta.get(), ida)) return flag;
    const double current = norm();
    if (current <= settings.newton.tolerance) return 0;
    const bool stalled = previous > 0 && current > settings.slow * previous;
    if (stalled && iterations > 2 && !call_setup && current <= settings.newton.acceptable)
      return 0;  // rounding
    if (iterations == settings.newton.max_iterations) return SUN_NLS_CONV_RECVR;
    settings.active_set(ycor, current_set);
    const bool fresh = call_setup || stalled || current_set != factored_set;
    if (fresh)
      if (const int flag = refactor(ida, iterations > 0)) return flag;
    request.reduction = linear_reduction(current, previous, fresh, settings.newton.tolerance);
    call_setup = false;
    previous = current;
    N_VScale(-1.0, delta.get(), delta.get());
    if (const int flag = solve(delta.get(), ida)) return flag;
    N_VLinearSum(1.0, ycor, 1.0, delta.get(), ycor);
    ++iterations;
    ++counters.newton_iterations;
  }
}

}  // namespace

NonlinearSolverOwner make_semismooth_newton(const Structure& structure, Counters& counters,
                                            Guard& guard, const SemismoothSettings& settings,
                                            LinearRequest& request, SUNContext context) {
  SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(context);
  check(solver, "SUNNonlinSolNewEmpty");
  NonlinearSolverOwner owner(solver);
  solver->content = new Content{structure, counters, guard,
                                settings,  request,  make_vector(structure.size, context)};
  auto* ops = solver->ops;
  ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
  ops->initialize = [](SUNNonlinearSolver) { return 0; };
  ops->solve = [](SUNNonlinearSolver s, N_Vector, N_Vector ycor, N_Vector, sunrealtype,
                  sunbooleantype call_setup, void* ida) {
    Content& c = content(s);
    int flag = -1;
    const int thrown = c.guard.run([&] { flag = c.iterate(ycor, call_setup, ida); });
    if (thrown) flag = thrown;
    if (flag) ++c.failures;
    return flag;
  };
  ops->setsysfn = [](SUNNonlinearSolver s, SUNNonlinSolSysFn f) {
    content(s).residual = f;
    return 0;
  };
  ops->setlsetupfn = [](SUNNonlinearSolver s, SUNNonlinSolLSetupFn f) {
    content(s).setup = f;
    return 0;
  };
  ops->setlsolvefn = [](SUNNonlinearSolver s, SUNNonlinSolLSolveFn f) {
    content(s).solve = f;
    return 0;
  };
  ops->getnumiters = [](SUNNonlinearSolver s, long* n) {
    *n = content(s).iterations;
    return 0;
  };
  ops->getnumconvfails = [](SUNNonlinearSolver s, long* n) {
    *n = content(s).failures;
    return 0;
  };
  ops->free = [](SUNNonlinearSolver s) {
    delete static_cast<Content*>(s->content);
    s->content = nullptr;
    SUNNonlinSolFreeEmpty(s);
    return 0;
  };
  return owner;
}

}  // namespace gnomon::sundials
