#include "newton/sundials_solvers.hpp"

#include <gnomon/newton/linear_solver_kind.hpp>
#include <limits>
#include <utility>

#include "newton/newton_policy.hpp"

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

struct NewtonContent {
  Counters& counters;
  Guard& guard;
  NewtonPolicy policy;
  ResidualNorm norm;
  PressureLevel level;
  std::function<Point(N_Vector ycor)> state_at;
  std::function<ActiveSet(const Point&)> branch_at;
  N_Vector differential;
  LinearRequest& request;
  SlowPart& slow;
  VectorOwner delta;
  SUNNonlinSolSysFn residual = nullptr;
  SUNNonlinSolLSetupFn setup = nullptr;
  SUNNonlinSolLSolveFn solve = nullptr;

  // Positive: recoverable, IDA shortens the step. Negative: fatal.
  int iterate(N_Vector ycor, N_Vector weights, bool set_up_demanded, void* ida) {
    using Verdict = NewtonPolicy::Verdict;
    policy.begin();
    double change = std::numeric_limits<double>::infinity();
    for (;;) {
      if (const int flag = residual(ycor, delta.get(), ida)) return flag;
      const Point at = state_at(ycor);
      const Verdict verdict =
          policy.judge({norm(view(delta.get())), branch_at(at), change, level(at.y)});
      if (verdict == Verdict::failed) return SUN_NLS_CONV_RECVR;
      if (verdict != Verdict::go_on) return 0;
      const bool at_guess = policy.iterations() == 0;
      const NewtonPolicy::Plan plan = policy.plan(at_guess && set_up_demanded);
      if (plan.whole) slow.known = false;
      if (plan.set_up)
        if (const int flag = set_up(!at_guess, ida)) return flag;
      request.reduction = plan.reduction;
      N_VScale(-1.0, delta.get(), delta.get());
      if (const int flag = solve(delta.get(), ida)) return flag;
      N_VLinearSum(1.0, ycor, 1.0, delta.get(), ycor);
      change = N_VWrmsNormMask(delta.get(), weights, differential);
      ++counters.newton_iterations;
    }
  }

  /// When a Jacobian is made in the middle of an iteration, IDA is told that the last one was bad.
  int set_up(bool after_iterations, void* ida) {
    int current = 0;
    const int flag = setup(after_iterations ? SUNFALSE : SUNTRUE, &current, ida);
    if (!flag) policy.factors_made();
    return flag;
  }
};

NewtonContent& content(SUNNonlinearSolver solver) {
  return *static_cast<NewtonContent*>(solver->content);
}

}  // namespace

LinearSolverOwner make_linear_solver(const Structure& structure, Counters& counters, Guard& guard,
                                     SUNContext context, const LinearRequest& request) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  check(solver, "SUNLinSolNewEmpty");
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
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

NonlinearSolverOwner make_semismooth_newton(const Structure& structure, Counters& counters,
                                            Guard& guard, const NewtonOptions& options,
                                            std::function<Point(N_Vector ycor)> state_at,
                                            std::function<ActiveSet(const Point&)> branch_at,
                                            N_Vector differential, LinearRequest& request,
                                            SlowPart& slow, SUNContext context) {
  SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(context);
  check(solver, "SUNNonlinSolNewEmpty");
  NonlinearSolverOwner owner(solver);
  solver->content = new NewtonContent{counters,
                                      guard,
                                      NewtonPolicy(options),
                                      ResidualNorm(structure),
                                      PressureLevel(structure),
                                      std::move(state_at),
                                      std::move(branch_at),
                                      differential,
                                      request,
                                      slow,
                                      make_vector(structure.size, context)};
  auto* ops = solver->ops;
  ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
  ops->solve = [](SUNNonlinearSolver s, N_Vector, N_Vector ycor, N_Vector weights, sunrealtype,
                  sunbooleantype call_setup, void* ida) {
    NewtonContent& c = content(s);
    int flag = -1;
    const int thrown = c.guard.run([&] { flag = c.iterate(ycor, weights, call_setup, ida); });
    if (thrown) flag = thrown;
    if (flag) c.policy.forget_factors();
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
  ops->free = [](SUNNonlinearSolver s) {
    delete static_cast<NewtonContent*>(s->content);
    s->content = nullptr;
    SUNNonlinSolFreeEmpty(s);
    return 0;
  };
  return owner;
}

void replace_content(SUNNonlinearSolver in_use, NonlinearSolverOwner by) {
  const NewtonContent& used = content(in_use);
  NewtonContent& fresh = content(by.get());
  fresh.residual = used.residual;
  fresh.setup = used.setup;
  fresh.solve = used.solve;
  std::swap(in_use->content, by->content);
}

}  // namespace gnomon::sundials
