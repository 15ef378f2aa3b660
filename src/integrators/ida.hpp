// IDA on a model, as the integrator bdf uses it: what it is set up with, and what it calls.
#pragma once

#include <fmt/format.h>
#include <idas/idas.h>

#include <algorithm>
#include <cmath>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <optional>
#include <utility>

#include "integrators/root_branch.hpp"
#include "newton/sundials_solvers.hpp"

namespace gnomon {

/// IDA on the DAE of a model. The error test contains only the differential components (weighted
/// root mean square over them; docs/integrators.md says which errors this does not control).
class Ida {
public:
  Ida(const System& system, const IntegratorSettings& settings, Counters& counters)
      : system_(&system),
        settings_(settings),
        counters_(counters),
        norm_(system.structure(), settings),
        y_(sundials::make_vector(system.structure().size, context_)),
        ydot_(sundials::make_vector(system.structure().size, context_)),
        id_(sundials::make_vector(system.structure().size, context_)),
        probe_(sundials::make_vector(system.structure().size, context_)),
        integral_(sundials::make_vector(1, context_)),
        solvers_(make_solvers()) {
    std::ranges::copy(system.structure().differential, sundials::view(id_.get()).begin());
  }

  /// Goes on with another system of the same unknowns: IDA keeps its handles, and what they hold is
  /// made for the new pattern.
  void adopt(const System& system, const IntegratorSettings& settings) {
    system_ = &system;
    settings_ = settings;
    norm_ = ErrorNorm(system.structure(), settings);
    slow_ = {};
    if (located_) located_->adopt(system);
    Solvers fresh = make_solvers();
    std::swap(solvers_.matrix->content, fresh.matrix->content);
    std::swap(solvers_.linear->content, fresh.linear->content);
    replace_content(solvers_.nonlinear.get(), std::move(fresh.nonlinear));
  }

  bool begun() const { return ida_ != nullptr; }
  void begin(const State& state, int max_order) {
    using sundials::check;
    take(state);
    ida_.reset(IDACreate(context_));
    void* ida = ida_.get();
    check(ida, "IDACreate");
    GNOMON_SILENCE(IDASetErrHandlerFn, ida);
    check(IDAInit(ida, &Ida::residual, state.t, y_.get(), ydot_.get()), "IDAInit");
    check(IDASetUserData(ida, this), "IDASetUserData");
    check(IDAWFtolerances(ida, &Ida::weights), "IDAWFtolerances");
    check(IDASetId(ida, id_.get()), "IDASetId");
    check(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
    check(IDASetMaxOrd(ida, max_order), "IDASetMaxOrd");
    // Where the solution ends, IDA would take ever smaller steps without an end. This limit ends
    // failing steps; vanishes() ends those that succeed.
    check(IDASetMinStep(ida, shortest_step(settings_)), "IDASetMinStep");
    if (settings_.max_step > 0) check(IDASetMaxStep(ida, settings_.max_step), "IDASetMaxStep");
    // Failures in one step; practically unlimited, because nearly every failure divides the step by
    // four.
    constexpr int most_failures = 30;
    check(IDASetMaxErrTestFails(ida, most_failures), "IDASetMaxErrTestFails");
    check(IDASetMaxConvFails(ida, most_failures), "IDASetMaxConvFails");
    check(IDASetLinearSolver(ida, solvers_.linear.get(), solvers_.matrix.get()),
          "IDASetLinearSolver");
    check(IDASetJacFn(ida, &Ida::jacobian), "IDASetJacFn");
    check(IDASetNonlinearSolver(ida, solvers_.nonlinear.get()), "IDASetNonlinearSolver");
    if (settings_.locate_events) {
      locate(state);
      check(IDARootInit(ida, located_->size(), &Ida::switching), "IDARootInit");
      check(IDASetNoInactiveRootWarn(ida), "IDASetNoInactiveRootWarn");
    }
    if (settings_.integrand)
      check(IDAQuadInit(ida, &Ida::integrand, integral_.get()), "IDAQuadInit");
  }

  /// Restarts at order one, as after an event or a breakpoint, because a polynomial through earlier
  /// states does not predict the rates there.
  void restart(const State& state) {
    take(state);
    sundials::check(IDAReInit(ida_.get(), state.t, y_.get(), ydot_.get()), "IDAReInit");
    rejected_ = 0;  // IDA's counts start anew
    if (!settings_.integrand) return;
    integrated_ = 0;
    N_VConst(0, integral_.get());
    sundials::check(IDAQuadReInit(ida_.get(), integral_.get()), "IDAQuadReInit");
  }

  /// One step at most to t_stop, in `reached`; `first`: its size after a restart, 0: IDA chooses.
  /// Returns whether it has ended at a root.
  bool step(double t_stop, double first, State& reached) {
    using sundials::check, sundials::view;
    void* ida = ida_.get();
    guard_.clear();
    from_ = reached.t;
    check(IDASetInitStep(ida, first), "IDASetInitStep");
    check(IDASetStopTime(ida, t_stop), "IDASetStopTime");
    const int flag = IDASolve(ida, t_stop, &reached.t, y_.get(), ydot_.get(), IDA_ONE_STEP);
    guard_.rethrow();
    count_rejected();
    if (flag < 0 || vanishes(reached.t - from_)) fail(flag);
    std::ranges::copy(view(y_.get()), reached.y.begin());
    set_rates(*system_, branch(), reached);
    return flag == IDA_ROOT_RETURN;
  }

  /// The order of the last step.
  int order() const {
    int order = 0;
    sundials::check(IDAGetLastOrder(ida_.get(), &order), "IDAGetLastOrder");
    return order;
  }
  /// The integral over the steps since the last call.
  double take_integral() {
    if (!settings_.integrand) return 0;
    sunrealtype t = 0;
    sundials::check(IDAGetQuad(ida_.get(), &t, integral_.get()), "IDAGetQuad");
    const double reached = sundials::view(integral_.get())[0];
    return reached - std::exchange(integrated_, reached);
  }

  /// The branch of the steps while events are located, otherwise null.
  const ActiveSet* branch() const { return located_ ? &located_->active() : nullptr; }
  /// Begins with the branch of this state.
  void locate(const State& state) { located_.emplace(*system_, state.t, state.y, settings_.end); }
  /// Switches nodes at the end of a step, and returns how many.
  int switch_nodes(const State& state, bool at_root) {
    std::vector<int> roots(branch()->size(), 0);
    if (at_root) sundials::check(IDAGetRootInfo(ida_.get(), roots.data()), "IDAGetRootInfo");
    return located_->switch_nodes(state.t, state.y, at_root ? &roots : nullptr);
  }

private:
  /// What IDA solves with; made for one pattern.
  struct Solvers {
    sundials::MatrixOwner matrix;
    sundials::LinearSolverOwner linear;
    sundials::NonlinearSolverOwner nonlinear;
  };
  Solvers make_solvers() {
    const Structure& structure = system_->structure();
    const auto state_at = [this](N_Vector ycor) {
      N_Vector predicted = nullptr, yy, yp, res;
      sunrealtype t, gamma;
      void* user = nullptr;
      sundials::check(IDAGetNonlinearSystemData(ida_.get(), &t, &predicted, &res, &yy, &yp, &res,
                                                &gamma, &user),
                      "IDAGetNonlinearSystemData");
      N_VLinearSum(1.0, predicted, 1.0, ycor, probe_.get());
      return Point{t, sundials::view(probe_.get())};
    };
    const auto branch_at = [this](const Point& at) {
      return branch() ? *branch() : active_set(*system_, at.t, at.y);
    };
    return {sundials::make_matrix(structure.pattern, context_),
            make_linear_solver(structure, counters_, guard_, context_, request_),
            make_semismooth_newton(structure, counters_, guard_,
                                   within_time_error(newton_in_ida, settings_.nonlinear_fraction),
                                   state_at, branch_at, id_.get(), request_, slow_, context_)};
  }

  void take(const State& state) {
    std::ranges::copy(state.y, sundials::view(y_.get()).begin());
    std::ranges::copy(state.ydot, sundials::view(ydot_.get()).begin());
  }

  /// Counts the attempts that IDA rejected in the last step.
  void count_rejected() {
    long error_fails = 0, newton_fails = 0;
    sundials::check(IDAGetNumErrTestFails(ida_.get(), &error_fails), "IDAGetNumErrTestFails");
    sundials::check(IDAGetNumStepSolveFails(ida_.get(), &newton_fails), "IDAGetNumStepSolveFails");
    const long rejected = error_fails + newton_fails;
    counters_.rejected_steps += rejected - std::exchange(rejected_, rejected);
  }

  /// Where the solution ends, steps succeed but become ever smaller. Returns true if this persists.
  bool vanishes(double step) {
    constexpr int many = 20;
    constexpr double tiny =
        1e-12;  // part of the run; a hundred of the shortest steps (stop_times.hpp)
    const bool tiny_for_a_reason = step < tiny * settings_.end && !guard_.recoverable().empty();
    vanishing_ = tiny_for_a_reason ? vanishing_ + 1 : 0;
    return vanishing_ == many;
  }

  [[noreturn]] void fail(int flag) const {
    const char* what = flag == IDA_ERR_FAIL       ? "the error test failed at the smallest step"
                       : flag == IDA_CONV_FAIL    ? "Newton failed at the smallest step"
                       : flag == IDA_TOO_MUCH_ACC ? "the tolerance is below rounding"
                       : flag < 0                 ? "IDA stopped"
                                                  : "steps become too small";
    throw SolutionError(
        fmt::format("bdf cannot continue from t = {:.6g}: {} (code {}){}{}", from_, what, flag,
                    guard_.recoverable().empty() ? "" : "; last: ", guard_.recoverable()));
  }

  static int residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector F, void* data) {
    Ida& self = *static_cast<Ida*>(data);
    return self.guard_.run([&] {
      ++self.counters_.residual_evaluations;
      self.system_->residual(self.point(t, y, ydot), sundials::view(F));
      sundials::require_finite(sundials::view(F), "the residual");
    });
  }

  static int jacobian(sunrealtype t, sunrealtype alpha, N_Vector y, N_Vector ydot, N_Vector,
                      SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
    Ida& self = *static_cast<Ida*>(data);
    return self.guard_.run([&] {
      ++self.counters_.jacobian_evaluations;
      Point at = self.point(t, y, ydot);
      at.slow = &self.slow_;
      self.system_->jacobian(at, alpha, sundials::values(J));
    });
  }

  // IDA averages the masked squares over ALL components; the factor makes it the mean over the
  // differential ones, so that the meaning of rtol does not depend on the number of algebraic
  // unknowns.
  static int weights(N_Vector y, N_Vector w, void* data) {
    const Ida& self = *static_cast<Ida*>(data);
    const std::span<const double> value = sundials::view(y);
    const double spread = std::sqrt(double(value.size()) / double(self.norm_.components().size()));
    for (std::size_t i = 0; i < value.size(); ++i)
      sundials::view(w)[i] = spread * self.norm_.weight(i, value[i]);
    return 0;
  }

  static int switching(sunrealtype t, N_Vector y, N_Vector ydot, sunrealtype* values, void* data) {
    Ida& self = *static_cast<Ida*>(data);
    return self.guard_.run([&] {
      self.system_->switching({.t = t, .y = sundials::view(y), .ydot = sundials::view(ydot)},
                              std::span<double>(values, self.branch()->size()));
    });
  }

  // IDA integrates it by its own formula, order and step; it does not take part in the error test.
  static int integrand(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector value, void* data) {
    Ida& self = *static_cast<Ida*>(data);
    return self.guard_.run(
        [&] { sundials::view(value)[0] = self.settings_.integrand(self.point(t, y, ydot)); });
  }

  Point point(double t, N_Vector y, N_Vector ydot) const {
    return {t, sundials::view(y), sundials::view(ydot), branch(), from_};
  }

  const System* system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ErrorNorm norm_;
  std::optional<RootBranch> located_;  // while events are located
  long rejected_ = 0;                  // IDA's count
  double from_ = 0;                    // start of the step, on whose side of a jump it lies
  int vanishing_ = 0;                  // steps, one after the other
  double integrated_ = 0;              // value of the quadrature that has been taken
  sundials::LinearRequest request_;
  SlowPart slow_;  // of the Jacobian
  sundials::Guard guard_;
  // Destroyed in reverse: IDA before what it refers to, the context last.
  sundials::Context context_;
  sundials::VectorOwner y_, ydot_, id_, probe_, integral_;
  Solvers solvers_;
  sundials::Owner<void, IDAFree> ida_;
};

}  // namespace gnomon
