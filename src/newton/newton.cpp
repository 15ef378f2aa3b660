#include <fmt/format.h>
#include <kinsol/kinsol.h>

#include <algorithm>
#include <gnomon/newton/interruption.hpp>
#include <gnomon/newton/newton.hpp>

#include "newton/newton_policy.hpp"
#include "newton/sundials_solvers.hpp"

namespace gnomon {

using namespace sundials;

class NewtonSolver::Memory {
public:
  Memory(const Structure& structure, Counters& counters, const NewtonOptions& options)
      : structure_(structure),
        counters_(counters),
        options_(options),
        policy_(options),
        norm_(structure),
        level_(structure),
        y_(make_vector(structure.size, context_)),
        unknown_scale_(make_vector(structure.size, context_)),
        row_scale_(make_vector(structure.size, context_)),
        matrix_(make_matrix(structure.pattern, context_)),
        linear_(make_linear_solver(structure, counters, guard_, context_, request_)),
        kinsol_(KINCreate(context_)) {
    for (long i = 0; i < structure.size; ++i)
      view(unknown_scale_.get())[i] = 1 / structure.unknown_scale[i];
    void* k = kinsol_.get();
    check(k, "KINCreate");
    GNOMON_SILENCE(KINSetErrHandlerFn, k);
    check(KINInit(k, &Memory::residual, y_.get()), "KINInit");
    check(KINSetUserData(k, this), "KINSetUserData");
    check(KINSetLinearSolver(k, linear_.get(), matrix_.get()), "KINSetLinearSolver");
    // KINSOL takes the steps and the policy decides. It decides when KINSOL requests a Jacobian:
    // before every iteration, also when KINSOL itself would stop.
    constexpr double never = 1e-300;  // KINSOL stops only at a residual of zero
    check(KINSetJacFn(k, &Memory::next_step), "KINSetJacFn");
    check(KINSetMaxSetupCalls(k, 1), "KINSetMaxSetupCalls");
    check(KINSetNumMaxIters(k, options.max_iterations + 1), "KINSetNumMaxIters");
    check(KINSetFuncNormTol(k, never), "KINSetFuncNormTol");
    // Steps of a few rounding errors of y are useless.
    check(KINSetScaledStepTol(k, 1e-15), "KINSetScaledStepTol");
    // The default bound (1000, or 1000 |u_0|) would clip the first step from rest.
    check(KINSetMaxNewtonStep(k, 1e100), "KINSetMaxNewtonStep");
  }

  NewtonReport solve(const NonlinearFunction& function, std::span<double> y) {
    if (counters_.newton_iterations > counters_.most_newton_iterations)
      throw SolutionError("the run takes more Newton iterations than it may");
    function_ = &function;
    norm_.allow_for_rounding(function.rate_weight, y, options_.acceptable);
    for (long i = 0; i < structure_.size; ++i) view(row_scale_.get())[i] = 1 / norm_.scale()[i];
    int flag = solve_from(y);
    if (!accepted(flag) && (policy_.began_with_kept_factors() || used_old_part_)) {
      policy_.forget_factors();
      flag = solve_from(y);
    }
    std::copy(view(y_.get()).begin(), view(y_.get()).end(), y.begin());
    NewtonReport report;
    report.converged = accepted(flag);
    report.iterations = iterations();
    report.norms = norms_;
    if (!report.converged) {
      report.reason = reason(flag);
      policy_.forget_factors();
    }
    return report;
  }

private:
  using Verdict = NewtonPolicy::Verdict;
  static int residual(N_Vector y, N_Vector G, void* data) {
    Memory& self = *static_cast<Memory*>(data);
    return self.guard_.run([&] {
      ++self.counters_.residual_evaluations;
      self.function_->residual(view(y), view(G));
      require_finite(view(G), "the residual");
      self.norms_.push_back(self.norm_(view(G)));
    });
  }

  // KINSOL requests a Jacobian before every iteration (KINSetMaxSetupCalls). The return value stops
  // it if the policy decides so.
  static int next_step(N_Vector y, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector) {
    constexpr int stop = 1;
    Memory& self = *static_cast<Memory*>(data);
    const int thrown = self.guard_.run([&] {
      require_uninterrupted();
      const NewtonPolicy::Iterate iterate = self.iterate(y);
      self.verdict_ = self.policy_.judge(iterate);
      if (self.verdict_ != Verdict::go_on) return;
      self.branches_.push_back(iterate.branch);
      self.set_up(self.policy_.plan(), y, J);
    });
    return thrown ? thrown : self.verdict_ == Verdict::go_on ? 0 : stop;
  }

  NewtonPolicy::Iterate iterate(N_Vector vector) {
    const std::span<const double> y = view(vector);
    NewtonPolicy::Iterate iterate{norms_.back()};
    if (function_->branch) iterate.branch = function_->branch(y);
    if (!function_->distance) return iterate;
    iterate.level = level_(y);
    if (!last_.empty()) iterate.change = function_->distance(last_, y);
    last_.assign(y.begin(), y.end());
    return iterate;
  }

  void set_up(const NewtonPolicy::Plan& plan, N_Vector y, SUNMatrix J) {
    request_ = {.keep = !plan.set_up, .reduction = plan.reduction};
    if (!plan.set_up) return;
    ++counters_.jacobian_evaluations;
    if (SlowPart* slow = function_->slow) {
      if (plan.whole) slow->known = false;
      used_old_part_ = used_old_part_ || slow->known;
    }
    function_->jacobian(view(y), values(J));
    policy_.factors_made();  // KINSOL makes them next
  }

  int solve_from(std::span<const double> guess) {
    std::copy(guess.begin(), guess.end(), view(y_.get()).begin());
    norms_.clear();
    branches_.clear();
    last_.clear();
    verdict_ = Verdict::go_on;
    used_old_part_ = false;
    guard_.clear();
    policy_.begin(function_->rate_weight);
    const int flag =
        KINSol(kinsol_.get(), y_.get(), KIN_NONE, unknown_scale_.get(), row_scale_.get());
    guard_.rethrow();
    counters_.newton_iterations += iterations();
    return flag;
  }

  /// KINSOL's count: an iteration that is stopped at rounding counts, as in all published counts of
  /// gnomon.
  int iterations() const {
    const int steps = policy_.iterations();
    return verdict_ == Verdict::rounding && steps < options_.max_iterations ? steps + 1 : steps;
  }
  bool accepted(int flag) const {
    if (flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK) return true;  // a residual of zero
    if (verdict_ == Verdict::done || verdict_ == Verdict::rounding) return true;
    return flag == KIN_STEP_LT_STPTOL && !norms_.empty() && norms_.back() <= options_.acceptable;
  }

  std::string reason(int flag) const {
    if (!guard_.recoverable().empty()) return guard_.recoverable();
    if (verdict_ == Verdict::failed)
      return fmt::format("Newton did not converge in {} iterations{}", options_.max_iterations,
                         cycling());
    if (flag == KIN_STEP_LT_STPTOL)
      return fmt::format(
          "Newton's steps become too small at {:.2g} times the scale of the residual",
          norms_.back());
    if (flag == KIN_MXNEWT_5X_EXCEEDED) return "Newton's steps grow without bound";
    return fmt::format("KINSOL stopped with code {}", flag);
  }

  /// The nodes that kept switching in the last iterations: three times in eight means a cycle of
  /// two or three active sets, not a moving edge of contact. Four nodes are enough to find the
  /// place.
  std::string cycling() const {
    constexpr std::size_t window = 8;
    constexpr int many = 3, most_shown = 4;
    if (branches_.size() < window) return {};
    std::string nodes;
    int shown = 0;
    for (std::size_t j = 0; j < branches_.back().size(); ++j) {
      int switches = 0;
      for (std::size_t k = branches_.size() - window + 1; k < branches_.size(); ++k)
        switches += branches_[k][j] != branches_[k - 1][j];
      if (switches < many || shown == most_shown) continue;
      const int node = j < function_->switch_node.size() ? function_->switch_node[j] : int(j);
      nodes += (shown++ ? ", " : "") + std::to_string(node);
    }
    return nodes.empty() ? "" : "; the active set cycles at nodes " + nodes;
  }

  const Structure& structure_;
  Counters& counters_;
  NewtonOptions options_;
  NewtonPolicy policy_;
  ResidualNorm norm_;
  PressureLevel level_;
  const NonlinearFunction* function_ = nullptr;
  // Data of the present solve.
  std::vector<double> norms_;        // of the iterates
  std::vector<ActiveSet> branches_;  // of the iterates
  std::vector<double> last_;         // the last iterate
  Verdict verdict_ = Verdict::go_on;
  bool used_old_part_ = false;  // a Jacobian with the slow part of an earlier one
  LinearRequest request_;
  Guard guard_;
  // Destroyed in reverse: the solver before what it refers to, the context last.
  Context context_;
  VectorOwner y_, unknown_scale_, row_scale_;
  MatrixOwner matrix_;
  LinearSolverOwner linear_;
  Owner<void, KINFree> kinsol_;
};

NewtonSolver::NewtonSolver(const Structure& structure, Counters& counters,
                           const NewtonOptions& options)
    : memory_(std::make_unique<Memory>(structure, counters, options)) {}
NewtonSolver::~NewtonSolver() = default;

NewtonReport NewtonSolver::solve(const NonlinearFunction& function, std::span<double> y) {
  return memory_->solve(function, y);
}

}  // namespace gnomon
