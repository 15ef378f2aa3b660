#include <fmt/format.h>
#include <ida/ida.h>

#include <algorithm>
#include <cmath>
#include <gnomon/integrators/bdf.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/step_size.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/newton/stage_solver.hpp>
#include <optional>

#include "newton/semismooth_newton.hpp"

namespace gnomon {

using namespace sundials;

namespace {
void destroy_ida(void* memory) {
  IDAFree(&memory);
}
}  // namespace

class BdfSolver::Memory {
public:
  Memory(const System& system, const IntegratorSettings& settings, Counters& counters);
  StepReport advance(State& state, double t_stop);

private:
  static int residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector F, void* self);
  static int jacobian(sunrealtype t, sunrealtype alpha, N_Vector y, N_Vector ydot, N_Vector F,
                      SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector w, void* self);
  static int switching(sunrealtype t, N_Vector y, N_Vector ydot, sunrealtype* values, void* self);
  void begin(const State& state);
  int switch_nodes(const State& state, bool at_root);
  bool cross_event(State& state, bool at_root, StepReport& report);
  void restart(const State& state);
  StepReport skip_to(State& state, double t);
  const ActiveSet* piece() const { return settings_.locate_events ? &piece_ : nullptr; }
  [[noreturn]] void fail(int flag, double t) const;

  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ErrorNorm norm_;
  bool begun_ = false;
  long rejected_ = 0;
  int vanishing_ = 0;                // steps, one after the other
  ActiveSet piece_;                  // the smooth piece that steps stay on while events are located
  std::vector<double> switched_at_;  // time of each node's last event
  std::optional<StageSolver> stages_;  // made at the first event
  LinearRequest request_;
  Guard guard_;
  // Destroyed in reverse: IDA before what it refers to, the context last.
  Context context_;
  VectorOwner y_, ydot_, id_, probe_;
  MatrixOwner matrix_;
  LinearSolverOwner linear_;
  NonlinearSolverOwner nonlinear_;
  Owner<void, destroy_ida> ida_;
};

BdfSolver::Memory::Memory(const System& system, const IntegratorSettings& settings,
                          Counters& counters)
    : system_(system),
      settings_(settings),
      counters_(counters),
      norm_(system.structure(), settings),
      y_(make_vector(system.structure().size, context_)),
      ydot_(make_vector(system.structure().size, context_)),
      id_(make_vector(system.structure().size, context_)),
      probe_(make_vector(system.structure().size, context_)),
      matrix_(make_matrix(system.structure(), context_)),
      linear_(make_linear_solver(system.structure(), counters, guard_, context_, request_)) {
  const auto& differential = system.structure().differential;
  std::copy(differential.begin(), differential.end(), view(id_.get()).begin());
  SemismoothSettings newton;
  newton.active_set = [this](N_Vector ycor, std::vector<char>& active) {
    N_Vector predicted = nullptr;
    sunrealtype t, gamma;
    N_Vector yy, yp, res;
    void* user = nullptr;
    check(
        IDAGetNonlinearSystemData(ida_.get(), &t, &predicted, &res, &yy, &yp, &res, &gamma, &user),
        "IDAGetNonlinearSystemData");
    N_VLinearSum(1.0, predicted, 1.0, ycor, probe_.get());
    active = piece() ? piece_ : active_set(system_, t, view(probe_.get()));
  };
  nonlinear_ =
      make_semismooth_newton(system.structure(), counters, guard_, newton, request_, context_);
}

void BdfSolver::Memory::begin(const State& state) {
  std::copy(state.y.begin(), state.y.end(), view(y_.get()).begin());
  std::copy(state.ydot.begin(), state.ydot.end(), view(ydot_.get()).begin());
  ida_.reset(IDACreate(context_));
  void* ida = ida_.get();
  check(ida, "IDACreate");
  GNOMON_SILENCE(IDASetErrHandlerFn, ida);
  check(IDAInit(ida, &Memory::residual, state.t, y_.get(), ydot_.get()), "IDAInit");
  check(IDASetUserData(ida, this), "IDASetUserData");
  check(IDAWFtolerances(ida, &Memory::weights), "IDAWFtolerances");
  check(IDASetId(ida, id_.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
  check(IDASetMaxOrd(ida, settings_.max_order), "IDASetMaxOrd");
  // IDA would creep up to where the solution ends by ever smaller steps, without an end, and where
  // this ends them, by steps that succeed (advance).
  check(IDASetMinStep(ida, 1e-14 * settings_.end), "IDASetMinStep");
  if (settings_.max_step > 0) check(IDASetMaxStep(ida, settings_.max_step), "IDASetMaxStep");
  check(IDASetMaxErrTestFails(ida, 30), "IDASetMaxErrTestFails");
  check(IDASetMaxConvFails(ida, 30), "IDASetMaxConvFails");
  check(IDASetLinearSolver(ida, linear_.get(), matrix_.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida, &Memory::jacobian), "IDASetJacFn");
  check(IDASetNonlinearSolver(ida, nonlinear_.get()), "IDASetNonlinearSolver");
  if (settings_.locate_events) {
    piece_ = active_set(system_, state.t, state.y);
    switched_at_.assign(piece_.size(), -settings_.end);
    check(IDARootInit(ida, static_cast<int>(piece_.size()), &Memory::switching), "IDARootInit");
    check(IDASetNoInactiveRootWarn(ida), "IDASetNoInactiveRootWarn");
  }
  begun_ = true;
}

int BdfSolver::Memory::residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector F, void* data) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.residual_evaluations;
    self.system_.residual({t, view(y), view(ydot), self.piece()}, view(F));
    require_finite(view(F), "the residual");
  });
}

int BdfSolver::Memory::jacobian(sunrealtype t, sunrealtype alpha, N_Vector y, N_Vector ydot,
                                N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.jacobian_evaluations;
    self.system_.jacobian({t, view(y), view(ydot), self.piece()}, alpha, values(J));
  });
}

// IDA averages the masked squares over ALL components; the factor makes it the mean over the
// differential ones, so that rtol means the same however many algebraic unknowns there are.
int BdfSolver::Memory::weights(N_Vector y, N_Vector w, void* data) {
  const Memory& self = *static_cast<Memory*>(data);
  const double spread = std::sqrt(double(view(y).size()) / double(self.norm_.components().size()));
  for (std::size_t i = 0; i < view(y).size(); ++i)
    view(w)[i] = spread * self.norm_.weight(view(y)[i]);
  return 0;
}

int BdfSolver::Memory::switching(sunrealtype t, N_Vector y, N_Vector, sunrealtype* values,
                                 void* data) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run(
      [&] { self.system_.switching(t, view(y), std::span<double>(values, self.piece_.size())); });
}

/// Switches the nodes at a root: the one that IDA names, and those that symmetry switches with it
/// but rounding puts just before or behind. Returns how many. A node that has just switched starts
/// from zero with a sign that is rounding's, and may reach its new piece by a root: it stays.
int BdfSolver::Memory::switch_nodes(const State& state, bool at_root) {
  constexpr double together = 1e-9;  // of the largest switching function
  constexpr double moment = 1e-6;    // of the run
  std::vector<int> found(piece_.size(), 0);
  if (at_root) check(IDAGetRootInfo(ida_.get(), found.data()), "IDAGetRootInfo");
  std::vector<double> values(piece_.size());
  system_.switching(state.t, state.y, values);
  double largest = 0;
  for (double value : values) largest = std::max(largest, std::abs(value));
  int switched = 0;
  for (std::size_t j = 0; j < piece_.size(); ++j) {
    if (state.t - switched_at_[j] <= moment * settings_.end) continue;
    const bool rooted = found[j] != 0 && (found[j] < 0) != bool(piece_[j]);
    if (found[j] != 0 && !rooted) continue;
    const bool off = (values[j] <= 0) != bool(piece_[j]);
    const bool beside = at_root && std::abs(values[j]) <= together * largest;
    if (!rooted && !off && !beside) continue;
    piece_[j] = !piece_[j];
    switched_at_[j] = state.t;
    ++switched;
  }
  return switched;
}

/// At an event the state is made consistent on the piece behind it. False where there is none.
bool BdfSolver::Memory::cross_event(State& state, bool at_root, StepReport& report) {
  report.switched = switch_nodes(state, at_root);
  if (report.switched == 0) return false;
  ++counters_.events;
  if (!stages_) stages_.emplace(system_, counters_);
  const std::string reason = stages_->solve(state.t, state.y, &piece_);
  if (!reason.empty()) throw SolutionError("bdf, after an event: " + reason);
  set_rates(system_, &piece_, state);
  return true;
}

/// Behind an event or a corner, where a polynomial through earlier states says nothing of the rates
/// to come: at order one.
void BdfSolver::Memory::restart(const State& state) {
  std::copy(state.y.begin(), state.y.end(), view(y_.get()).begin());
  std::copy(state.ydot.begin(), state.ydot.end(), view(ydot_.get()).begin());
  check(IDAReInit(ida_.get(), state.t, y_.get(), ydot_.get()), "IDAReInit");
  rejected_ = 0;  // IDA's counts start anew
}

/// Over a moment of rounding, as to a time to store that comes on resuming. IDA refuses such steps.
StepReport BdfSolver::Memory::skip_to(State& state, double t) {
  StepReport report;
  report.step = t - state.t;
  report.order = 1;
  state.t = t;
  restart(state);
  if (piece()) state.piece = piece_;
  ++counters_.steps;
  return report;
}

StepReport BdfSolver::Memory::advance(State& state, double t_stop) {
  if (!begun_) begin(state);
  void* ida = ida_.get();
  guard_.clear();
  const long newton_before = counters_.newton_iterations;
  t_stop = end_of_smooth_part(system_.structure(), state.t, t_stop);
  if (t_stop - state.t <= 1e-12 * t_stop) return skip_to(state, t_stop);
  check(IDASetStopTime(ida, t_stop), "IDASetStopTime");
  sunrealtype t = state.t;
  const int flag = IDASolve(ida, t_stop, &t, y_.get(), ydot_.get(), IDA_ONE_STEP);
  guard_.rethrow();
  long error_fails = 0, newton_fails = 0;
  check(IDAGetNumErrTestFails(ida, &error_fails), "IDAGetNumErrTestFails");
  check(IDAGetNumStepSolveFails(ida, &newton_fails), "IDAGetNumStepSolveFails");
  const long rejected = error_fails + newton_fails - rejected_;
  rejected_ += rejected;
  counters_.rejected_steps += rejected;
  if (flag < 0) fail(flag, state.t);
  // Where the solution ends, steps that succeed become ever smaller.
  const bool vanishes = t - state.t < 1e-12 * settings_.end && !guard_.recoverable().empty();
  vanishing_ = vanishes ? vanishing_ + 1 : 0;
  if (vanishing_ == 20) fail(flag, state.t);

  StepReport report;
  report.step = t - state.t;
  check(IDAGetLastOrder(ida, &report.order), "IDAGetLastOrder");
  report.newton_iterations = counters_.newton_iterations - newton_before;
  report.restarted = rejected > 0;
  ++counters_.steps;
  state.t = t;
  std::copy(view(y_.get()).begin(), view(y_.get()).end(), state.y.begin());
  set_rates(system_, piece(), state);
  const bool event = piece() && cross_event(state, flag == IDA_ROOT_RETURN, report);
  if (event || is_corner(system_.structure(), t)) restart(state);
  if (piece()) state.piece = piece_;
  return report;
}

void BdfSolver::Memory::fail(int flag, double t) const {
  const char* what = flag == IDA_ERR_FAIL       ? "the error test failed at the smallest step"
                     : flag == IDA_CONV_FAIL    ? "Newton failed at the smallest step"
                     : flag == IDA_TOO_MUCH_ACC ? "the tolerance is below rounding"
                     : flag < 0                 ? "IDA stopped"
                                                : "steps vanish";
  throw SolutionError(
      fmt::format("bdf cannot go on from t = {:.6g}: {} (code {}){}{}", t, what, flag,
                  guard_.recoverable().empty() ? "" : "; last: ", guard_.recoverable()));
}

BdfSolver::BdfSolver(const System& system, const IntegratorSettings& settings, Counters& counters)
    : memory_(std::make_unique<Memory>(system, settings, counters)) {}
BdfSolver::~BdfSolver() = default;

StepReport BdfSolver::advance(State& state, double t_stop) {
  return memory_->advance(state, t_stop);
}

}  // namespace gnomon
