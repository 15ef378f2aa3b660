#include <fmt/format.h>
#include <kinsol/kinsol.h>

#include <algorithm>
#include <cmath>
#include <gnomon/newton/newton.hpp>
#include <limits>
#include <tuple>

#include "newton/forcing.hpp"
#include "newton/linear_solver.hpp"

namespace gnomon {

using namespace sundials;

namespace {
void destroy_kinsol(void* memory) {
  KINFree(&memory);
}
}  // namespace

class NewtonSolver::Memory {
public:
  Memory(const Structure& structure, Counters& counters, const NewtonOptions& options);
  NewtonReport solve(const NonlinearFunction& function, std::span<double> y);

private:
  static int residual(N_Vector y, N_Vector G, void* self);
  static int jacobian(N_Vector y, N_Vector G, SUNMatrix J, void* self, N_Vector, N_Vector);
  int solve_once();
  bool factors_serve(const ActiveSet& piece) const;
  bool at_rounding() const;
  void scale_rates(double alpha, std::span<const double> y);
  bool accepted(int flag) const;
  std::string reason(int flag) const;
  std::string cycling() const;

  const Structure& structure_;
  Counters& counters_;
  NewtonOptions options_;
  const NonlinearFunction* function_ = nullptr;
  std::vector<double> scale_;  // of the rows
  std::vector<double> norms_;
  std::vector<ActiveSet> pieces_;  // of the iterates
  // What the factors (the Jacobian, for iterative solvers) were made for.
  bool factored_ = false, fresh_ = false, stalled_ = false;
  double factored_alpha_ = 0;
  ActiveSet factored_piece_;
  LinearRequest request_;
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
      scale_(structure.row_scale),
      y_(make_vector(structure.size, context_)),
      unknown_scale_(make_vector(structure.size, context_)),
      row_scale_(make_vector(structure.size, context_)),
      matrix_(make_matrix(structure, context_)),
      linear_(make_linear_solver(structure, counters, guard_, context_, request_)),
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
    self.norms_.push_back(scaled_norm(view(G), self.scale_));
  });
}

// KINSOL asks for a set-up before every iteration (KINSetMaxSetupCalls); here it is decided whether
// one is made.
int NewtonSolver::Memory::jacobian(N_Vector y, N_Vector, SUNMatrix J, void* data, N_Vector,
                                   N_Vector) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    const NonlinearFunction& function = *self.function_;
    const ActiveSet piece = function.piece ? function.piece(view(y)) : ActiveSet{};
    self.pieces_.push_back(piece);
    if (self.at_rounding()) {
      self.stalled_ = true;
      throw RecoverableError("rounding");  // the way to stop KINSOL here
    }
    self.fresh_ = !(self.options_.keep_factors && self.factors_serve(piece));
    const std::size_t n = self.norms_.size();
    self.request_ = {
        .keep = !self.fresh_,
        .reduction = linear_reduction(self.norms_.back(), n > 1 ? self.norms_[n - 2] : 0,
                                      self.fresh_, self.options_.tolerance)};
    if (!self.fresh_) return;
    self.factored_ = false;
    ++self.counters_.jacobian_evaluations;
    function.jacobian(view(y), values(J));
    self.factored_ = true;
    self.factored_alpha_ = function.alpha;
    self.factored_piece_ = piece;
  });
}

bool NewtonSolver::Memory::factors_serve(const ActiveSet& piece) const {
  constexpr double alpha_range = 1.4;
  if (!factored_ || piece != factored_piece_) return false;
  const double alpha = function_->alpha;
  if (alpha > alpha_range * factored_alpha_ || factored_alpha_ > alpha_range * alpha) return false;
  const std::size_t n = norms_.size();
  return n < 2 || norms_[n - 1] <= options_.slow * norms_[n - 2];
}

/// Where rates are alpha (y - base), as in short steps, rounding of y leaves more of them than
/// `acceptable` of their scale: what can be asked of those rows is less.
void NewtonSolver::Memory::scale_rates(double alpha, std::span<const double> y) {
  constexpr double roundings = 10 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!structure_.differential[i]) continue;
    const double rounding = roundings * alpha * std::abs(y[i]);
    scale_[i] = std::max(structure_.row_scale[i], rounding / options_.acceptable);
    view(row_scale_.get())[i] = 1 / scale_[i];
  }
}

/// A fresh Newton step from a small residual did not reduce it: rounding stands in the way.
bool NewtonSolver::Memory::at_rounding() const {
  const std::size_t n = norms_.size();
  return fresh_ && n >= 2 && norms_[n - 1] <= options_.acceptable &&
         norms_[n - 1] > 0.5 * norms_[n - 2];
}

std::string NewtonSolver::Memory::reason(int flag) const {
  if (!guard_.recoverable().empty()) return guard_.recoverable();
  if (flag == KIN_MAXITER_REACHED)
    return fmt::format("Newton did not converge in {} iterations{}", options_.max_iterations,
                       cycling());
  if (flag == KIN_STEP_LT_STPTOL)
    return fmt::format("Newton's steps vanish at {:.2g} times the scale of the residual",
                       norms_.back());
  return fmt::format("KINSOL stopped with code {}", flag);
}

/// Which nodes went on switching in the last iterations.
std::string NewtonSolver::Memory::cycling() const {
  constexpr std::size_t window = 8;
  if (pieces_.size() < window) return {};
  std::string nodes;
  int shown = 0;
  for (std::size_t j = 0; j < pieces_.back().size(); ++j) {
    int switches = 0;
    for (std::size_t k = pieces_.size() - window + 1; k < pieces_.size(); ++k)
      switches += pieces_[k][j] != pieces_[k - 1][j];
    if (switches < 3 || shown == 4) continue;
    const int node = j < function_->switch_node.size() ? function_->switch_node[j] : int(j);
    nodes += (shown++ ? ", " : "") + std::to_string(node);
  }
  return nodes.empty() ? "" : "; the active set cycles at nodes " + nodes;
}

bool NewtonSolver::Memory::accepted(int flag) const {
  if (flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK || stalled_) return true;
  // A vanishing step counts when the residual is small anyway.
  return (flag == KIN_STEP_LT_STPTOL || flag == KIN_MAXITER_REACHED) && !norms_.empty() &&
         norms_.back() <= options_.acceptable;
}

int NewtonSolver::Memory::solve_once() {
  norms_.clear();
  pieces_.clear();
  guard_.clear();
  fresh_ = stalled_ = false;
  const int flag =
      KINSol(kinsol_.get(), y_.get(), KIN_NONE, unknown_scale_.get(), row_scale_.get());
  guard_.rethrow();
  return flag;
}

NewtonReport NewtonSolver::Memory::solve(const NonlinearFunction& function, std::span<double> y) {
  function_ = &function;
  scale_rates(function.alpha, y);
  const auto from_guess = [&] {
    std::copy(y.begin(), y.end(), view(y_.get()).begin());
    const int flag = solve_once();
    long iterations = 0;
    check(KINGetNumNonlinSolvIters(kinsol_.get(), &iterations), "KINGetNumNonlinSolvIters");
    counters_.newton_iterations += iterations;
    return std::pair(flag, static_cast<int>(iterations));
  };
  const bool kept = options_.keep_factors && factored_;
  auto [flag, iterations] = from_guess();
  if (!accepted(flag) && kept) {  // kept factors may have led astray
    factored_ = false;
    std::tie(flag, iterations) = from_guess();
  }
  std::copy(view(y_.get()).begin(), view(y_.get()).end(), y.begin());
  NewtonReport report;
  report.converged = accepted(flag);
  report.iterations = iterations;
  report.norms = norms_;
  if (!report.converged) {
    report.reason = reason(flag);
    factored_ = false;
  }
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
