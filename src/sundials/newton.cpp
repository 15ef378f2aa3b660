#include <gnomon/sundials/newton.hpp>

#include <kinsol/kinsol.h>

#include <algorithm>
#include <limits>

#include "room.hpp"

namespace gnomon {

using namespace sundials;

namespace {
void destroy_kinsol(void* memory) { KINFree(&memory); }
}  // namespace

class NewtonSolver::Memory {
public:
  Memory(const Structure& structure, Counters& counters, const NewtonOptions& options);
  NewtonReport solve(const NonlinearFunction& function, std::span<double> y);

private:
  static int residual(N_Vector y, N_Vector G, void* self);
  static int jacobian(N_Vector y, N_Vector G, SUNMatrix J, void* self, N_Vector, N_Vector);
  std::string reason(int flag) const;

  const Structure& structure_;
  Counters& counters_;
  NewtonOptions options_;
  const NonlinearFunction* function_ = nullptr;
  std::vector<double> norms_;
  Guard guard_;
  // Destroyed in reverse: the solver before what it refers to, the context last.
  Context context_;
  VectorOwner y_, unknown_scale_, row_scale_;
  MatrixOwner matrix_;
  LinearSolverOwner linear_;
  Owner<void, destroy_kinsol> kinsol_;
};

NewtonSolver::Memory::Memory(const Structure& structure, Counters& counters,
                             const NewtonOptions& options)
    : structure_(structure),
      counters_(counters),
      options_(options),
      y_(make_vector(structure.size, context_)),
      unknown_scale_(make_vector(structure.size, context_)),
      row_scale_(make_vector(structure.size, context_)),
      matrix_(make_matrix(structure, context_)),
      linear_(make_linear_solver(structure, counters, guard_, context_)),
      kinsol_(KINCreate(context_)) {
  for (long i = 0; i < structure.size; ++i) {
    view(unknown_scale_.get())[i] = 1 / structure.unknown_scale[i];
    view(row_scale_.get())[i] = 1 / structure.row_scale[i];
  }
  void* k = kinsol_.get();
  check(k, "KINCreate");
  GNOMON_SILENCE(KINSetErrHandlerFn, k);
  check(KINInit(k, &Memory::residual, y_.get()), "KINInit");
  check(KINSetUserData(k, this), "KINSetUserData");
  check(KINSetLinearSolver(k, linear_.get(), matrix_.get()), "KINSetLinearSolver");
  check(KINSetJacFn(k, &Memory::jacobian), "KINSetJacFn");
  check(KINSetMaxSetupCalls(k, 1), "KINSetMaxSetupCalls");  // a fresh Jacobian every iteration
  check(KINSetNumMaxIters(k, options.max_iterations), "KINSetNumMaxIters");
  check(KINSetFuncNormTol(k, options.tolerance), "KINSetFuncNormTol");
  check(KINSetScaledStepTol(k, 1e-15), "KINSetScaledStepTol");
  // The default bound (1000, or 1000 |u_0|) would clip the first step from rest.
  check(KINSetMaxNewtonStep(k, 1e100), "KINSetMaxNewtonStep");
}

int NewtonSolver::Memory::residual(N_Vector y, N_Vector G, void* data) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.residual_evaluations;
    self.function_->residual(view(y), view(G));
    require_finite(view(G), "the residual");
    self.norms_.push_back(scaled_norm(view(G), self.structure_.row_scale));
  });
}

int NewtonSolver::Memory::jacobian(N_Vector y, N_Vector, SUNMatrix J, void* data, N_Vector,
                                   N_Vector) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.jacobian_evaluations;
    self.function_->jacobian(view(y), values(J));
  });
}

std::string NewtonSolver::Memory::reason(int flag) const {
  if (!guard_.recoverable().empty()) return guard_.recoverable();
  if (flag == KIN_MAXITER_REACHED)
    return "Newton did not converge in " + std::to_string(options_.max_iterations) + " iterations";
  return "KINSOL stopped with code " + std::to_string(flag);
}

NewtonReport NewtonSolver::Memory::solve(const NonlinearFunction& function, std::span<double> y) {
  function_ = &function;
  norms_.clear();
  guard_.clear();
  std::copy(y.begin(), y.end(), view(y_.get()).begin());
  const int flag =
      KINSol(kinsol_.get(), y_.get(), KIN_NONE, unknown_scale_.get(), row_scale_.get());
  guard_.rethrow();
  std::copy(view(y_.get()).begin(), view(y_.get()).end(), y.begin());

  NewtonReport report;
  long iterations = 0;
  check(KINGetNumNonlinSolvIters(kinsol_.get(), &iterations), "KINGetNumNonlinSolvIters");
  report.iterations = static_cast<int>(iterations);
  counters_.newton_iterations += iterations;
  report.norms = norms_;
  // KIN_SUCCESS, KIN_INITIAL_GUESS_OK; a vanishing step counts when the residual is small anyway.
  report.converged = flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK ||
                     ((flag == KIN_STEP_LT_STPTOL || flag == KIN_MAXITER_REACHED) &&
                      !norms_.empty() && norms_.back() <= options_.acceptable);
  if (!report.converged) report.reason = reason(flag);
  return report;
}

NewtonSolver::NewtonSolver(const Structure& structure, Counters& counters,
                           const NewtonOptions& options)
    : memory_(std::make_unique<Memory>(structure, counters, options)) {}
NewtonSolver::~NewtonSolver() = default;

NewtonReport NewtonSolver::solve(const NonlinearFunction& function, std::span<double> y) {
  return memory_->solve(function, y);
}

}  // namespace gnomon
