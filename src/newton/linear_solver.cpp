#include "newton/linear_solver.hpp"

#include <algorithm>
#include <gnomon/linear/sparse_lu.hpp>

#include "newton/krylov.hpp"

namespace gnomon::sundials {

namespace {

/// The content of the SUNLinearSolver: by blocks as long as they serve, else by factors.
class Content {
public:
  Content(const Structure& s, Counters& c, Guard& g, SUNContext context, const LinearRequest& r)
      : guard(g), request(r), structure_(s), counters_(c) {
    if (s.solver.method == LinearSolverChoice::Method::block)
      block_ = std::make_unique<BlockSolver>(s, c, context);
  }

  void set_up(std::span<const double> J) {
    J_ = J;
    by_factors_ = !block_;
    if (by_factors_ || !serves([&] { block_->set_up(J); })) factorize();
  }

  void solve(N_Vector x, N_Vector b) {
    ++counters_.linear_solves;
    if (!by_factors_ && serves([&] { solve_by_blocks(x, b); })) return;
    if (!by_factors_) factorize();
    if (x != b) return lu_->solve(view(b), view(x));
    const std::vector<double> right(view(b).begin(), view(b).end());  // IDA solves in place
    lu_->solve(right, view(x));
  }

  Guard& guard;
  const LinearRequest& request;

private:
  void solve_by_blocks(N_Vector x, N_Vector b) {
    // The reduction that a solve must reach to be useful to Newton's method.
    constexpr double useful = 0.3;
    if (!structure_.solver.direct_at_failure) return block_->solve(b, x, request.reduction, useful);
    // Where factors are affordable, an iteration of GMRES costs next to nothing, and a solve that
    // stays behind is not accepted. With 1e-4 a light load on a stiff, nearly incompressible pin
    // takes 306 instead of 82 Newton iterations.
    constexpr double loosest = 1e-8;
    block_->solve(b, x, std::min(request.reduction, loosest), loosest);
  }

  /// Whether the blocks could do it; throws if nothing else is at hand.
  template <class Task>
  bool serves(const Task& task) {
    if (!structure_.solver.direct_at_failure) return task(), true;
    try {
      return task(), true;
    } catch (const RecoverableError&) {
      return false;
    }
  }

  /// Until the next set-up, factors of the whole Jacobian solve.
  void factorize() {
    if (!lu_) lu_ = std::make_unique<SparseLu>(structure_.pattern, structure_.group);
    ++counters_.factorizations;
    if (!lu_->factorize(J_)) throw RecoverableError("the Jacobian is singular");
    by_factors_ = true;
  }

  const Structure& structure_;
  Counters& counters_;
  std::unique_ptr<BlockSolver> block_;
  std::unique_ptr<SparseLu> lu_;  // made when first needed
  std::span<const double> J_;
  bool by_factors_ = false;
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
    return c.request.keep ? 0 : c.guard.run([&] { c.set_up(values(J)); });
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
