#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/integrators/arkode_table.hpp>
#include <gnomon/integrators/erk.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/step_size.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/newton/stage_solver.hpp>

#include "sundials/room.hpp"

namespace gnomon {

using namespace sundials;

namespace {
void destroy_erk(void* memory) {
  ARKodeFree(&memory);
}
void destroy_table(ARKodeButcherTableMem* table) {
  ARKodeButcherTable_Free(table);
}
using TableOwner = Owner<ARKodeButcherTableMem, destroy_table>;

/// ERKStep takes (until 6.7) the rate of a last stage at c = 1 for the rate at the end of the step,
/// which holds only where that stage is the new value; Heun's is not, and would lose half its
/// stability. Where needed, the new value is appended as a stage of no weight, whose rate the next
/// step uses.
TableOwner table_with_end(const ButcherTable& table) {
  const bool ends_on_value = table.stiffly_accurate() || table.c[table.stages() - 1] != 1;
  const int s = table.stages(), n = ends_on_value ? s : s + 1;
  TableOwner result(ARKodeButcherTable_Alloc(n, SUNTRUE));
  check(result.get(), "ARKodeButcherTable_Alloc");
  result->q = table.order;
  result->p = table.embedded_order;
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j < s; ++j) result->A[i][j] = table.A(i, j);
    result->b[i] = table.b[i];
    result->c[i] = table.c[i];
    result->d[i] = table.b_embedded[i];
  }
  if (ends_on_value) return result;
  for (int j = 0; j < s; ++j) result->A[s][j] = table.b[j];
  result->c[s] = 1;
  return result;
}
}  // namespace

class ErkSolver::Memory {
public:
  Memory(const System& system, const IntegratorSettings& settings, Counters& counters,
         const std::string& table);
  StepReport advance(State& state, double t_stop);
  double proposal() const { return proposal_; }
  void restore(double proposal);

private:
  static int rate(sunrealtype t, N_Vector d, N_Vector ddot, void* self);
  static int weights(N_Vector d, N_Vector w, void* self);
  void begin(const State& state);
  void restart(const State& state, double h);
  void set_step(const State& state, double t_stop);
  void evaluate(double t, std::span<const double> d);
  void gather(const std::vector<double>& y, std::span<double> d) const;

  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ButcherTable table_;
  ErrorNorm norm_;
  StageSolver stages_;
  State whole_;      // consistent state of the last evaluation, the guess for the next
  double proposal_;  // what is tried next; 0 before the first of the steps that are chosen
  long rejected_ = 0;
  Guard guard_;
  // Destroyed in reverse: ERKStep before what it refers to, the context last.
  Context context_;
  StepControl step_control_;
  VectorOwner d_;
  Owner<void, destroy_erk> erk_;
};

ErkSolver::Memory::Memory(const System& system, const IntegratorSettings& settings,
                          Counters& counters, const std::string& table)
    : system_(system),
      settings_(settings),
      counters_(counters),
      table_(arkode_erk_table(table)),
      norm_(system.structure(), settings),
      stages_(system, counters),
      proposal_(settings.step),
      step_control_(context_),
      d_(make_vector(static_cast<long>(norm_.components().size()), context_)) {}

void ErkSolver::Memory::gather(const std::vector<double>& y, std::span<double> d) const {
  for (std::size_t k = 0; k < d.size(); ++k) d[k] = y[norm_.components()[k]];
}

/// Makes whole_ the consistent state with differential components d, its rates included.
void ErkSolver::Memory::evaluate(double t, std::span<const double> d) {
  State next = whole_;
  next.t = t;
  for (std::size_t k = 0; k < d.size(); ++k) next.y[norm_.components()[k]] = d[k];
  const std::string reason = stages_.solve(t, next.y);
  if (!reason.empty()) throw RecoverableError(reason);
  set_rates(system_, nullptr, next);
  whole_ = std::move(next);
}

int ErkSolver::Memory::rate(sunrealtype t, N_Vector d, N_Vector ddot, void* data) {
  Memory& self = *static_cast<Memory*>(data);
  return self.guard_.run([&] {
    self.evaluate(t, view(d));
    self.gather(self.whole_.ydot, view(ddot));
  });
}

int ErkSolver::Memory::weights(N_Vector d, N_Vector w, void* data) {
  const Memory& self = *static_cast<Memory*>(data);
  for (std::size_t k = 0; k < view(d).size(); ++k) view(w)[k] = self.norm_.weight(view(d)[k]);
  return 0;
}

void ErkSolver::Memory::begin(const State& state) {
  whole_ = state;
  gather(state.y, view(d_.get()));
  erk_.reset(ERKStepCreate(&Memory::rate, state.t, d_.get(), context_));
  void* erk = erk_.get();
  check(erk, "ERKStepCreate");
  GNOMON_SILENCE(ERKStepSetErrHandlerFn, erk);
  check(ARKodeSetUserData(erk, this), "ARKodeSetUserData");
  check(ERKStepSetTable(erk, table_with_end(table_).get()), "ERKStepSetTable");
  check(ARKodeWFtolerances(erk, &Memory::weights), "ARKodeWFtolerances");
  check(step_control_.give_to(erk), "StepControl");
  check(ARKodeSetMaxGrowth(erk, 5.0), "ARKodeSetMaxGrowth");
  check(ARKodeSetMaxErrTestFails(erk, 30), "ARKodeSetMaxErrTestFails");
  check(ARKodeSetMaxNumSteps(erk, -1), "ARKodeSetMaxNumSteps");
  if (settings_.max_step > 0) check(ARKodeSetMaxStep(erk, settings_.max_step), "ARKodeSetMaxStep");
  if (settings_.step > 0) return;
  if (proposal_ > 0)  // not the first step, which may be far too small
    check(ARKodeSetMaxFirstGrowth(erk, 5.0), "ARKodeSetMaxFirstGrowth");
  else
    proposal_ = first_step(state, system_.structure(), settings_, table_.embedded_order);
  check(ARKodeSetInitStep(erk, proposal_), "ARKodeSetInitStep");
}

void ErkSolver::Memory::restore(double proposal) {
  proposal_ = settings_.step > 0 ? std::min(proposal, settings_.step) : proposal;
}

/// After a failed evaluation: from the last good state with a shorter step.
void ErkSolver::Memory::restart(const State& state, double h) {
  whole_ = state;
  gather(state.y, view(d_.get()));
  check(ARKodeReset(erk_.get(), state.t, d_.get()), "ARKodeReset");
  if (settings_.step > 0)
    proposal_ = h;
  else
    check(ARKodeSetInitStep(erk_.get(), h), "ARKodeSetInitStep");
}

void ErkSolver::Memory::set_step(const State& state, double t_stop) {
  check(ARKodeSetStopTime(erk_.get(), t_stop), "ARKodeSetStopTime");
  if (settings_.step == 0) return;
  const double left = end_of_fixed_step(state.t, settings_.step, t_stop) - state.t;
  check(ARKodeSetFixedStep(erk_.get(), proposal_ < left * (1 - sliver) ? proposal_ : left),
        "ARKodeSetFixedStep");
}

StepReport ErkSolver::Memory::advance(State& state, double t_stop) {
  constexpr int most_failures = 30;
  if (!erk_) begin(state);
  void* erk = erk_.get();
  t_stop = end_of_smooth_part(system_.structure(), state.t, t_stop);
  const long newton_before = counters_.newton_iterations;
  StepReport report;
  for (int failures = 0;; ++failures) {
    set_step(state, t_stop);
    guard_.clear();
    sunrealtype t = state.t, tried = 0;
    const int flag = ARKodeEvolve(erk, t_stop, d_.get(), &t, ARK_ONE_STEP);
    const bool done =
        flag >= 0 && guard_.run([&] { evaluate(t, view(d_.get())); }) == 0;  // where it has come to
    guard_.rethrow();
    long error_fails = 0;
    check(ARKodeGetNumErrTestFails(erk, &error_fails), "ARKodeGetNumErrTestFails");
    counters_.rejected_steps += error_fails - rejected_;
    report.restarted |= error_fails > rejected_;
    rejected_ = error_fails;
    if (done) {
      report.step = t - state.t;
      break;
    }
    if (flag >= 0)
      tried = t - state.t;
    else
      check(ARKodeGetCurrentStep(erk, &tried), "ARKodeGetCurrentStep");
    // Ever smaller steps would creep up to where the solution ends.
    const bool shortest = tried <= 1e-14 * settings_.end;
    if (guard_.recoverable().empty() || shortest || failures == most_failures)
      throw SolutionError(
          fmt::format("{} cannot go on from t = {:.6g}: code {}{}{}", table_.name, state.t, flag,
                      guard_.recoverable().empty() ? "" : "; last: ", guard_.recoverable()));
    ++counters_.rejected_steps;
    report.restarted = true;
    restart(state, std::min(tried, t_stop - state.t) / 2);
  }
  if (settings_.step > 0)
    proposal_ = std::min(settings_.step, 2 * proposal_);
  else
    check(ARKodeGetCurrentStep(erk, &proposal_), "ARKodeGetCurrentStep");
  state = whole_;
  ++counters_.steps;
  report.order = table_.order;
  report.newton_iterations = counters_.newton_iterations - newton_before;
  return report;
}

ErkSolver::ErkSolver(const System& system, const IntegratorSettings& settings, Counters& counters,
                     const std::string& table)
    : memory_(std::make_unique<Memory>(system, settings, counters, table)) {}
ErkSolver::~ErkSolver() = default;

std::vector<double> ErkSolver::memory() const {
  return {memory_->proposal()};
}

void ErkSolver::restore(const State&, std::span<const double> memory) {
  if (memory.empty()) throw InputError("the checkpoint does not belong to this integrator");
  memory_->restore(memory.front());
}

StepReport ErkSolver::advance(State& state, double t_stop) {
  return memory_->advance(state, t_stop);
}

}  // namespace gnomon
