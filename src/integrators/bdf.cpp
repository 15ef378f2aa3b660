#include <fmt/format.h>

#include <algorithm>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/stop_rules.hpp>
#include <utility>

#include "integrators/bdf_memory.hpp"

namespace gnomon {

using namespace sundials;

/// At an event the state is made consistent on the branch after the event. Returns false if there
/// is no event.
bool BdfMemory::cross_event(State& state, bool at_root, StepReport& report) {
  std::vector<int> roots(branch_->size(), 0);
  if (at_root) check(IDAGetRootInfo(ida_.get(), roots.data()), "IDAGetRootInfo");
  report.switched = branch_->switch_nodes(state.t, state.y, at_root ? &roots : nullptr);
  if (report.switched == 0) return false;
  ++counters_.events;
  if (!algebraic_) algebraic_.emplace(*system_, counters_);
  const std::string reason = algebraic_->solve(state.t, state.y, branch());
  if (!reason.empty()) throw SolutionError("bdf, after an event: " + reason);
  set_rates(*system_, branch(), state);
  return true;
}

/// Restarts at order one after an event or a breakpoint, because a polynomial through earlier
/// states does not predict the rates there.
void BdfMemory::restart(const State& state) {
  std::copy(state.y.begin(), state.y.end(), view(y_.get()).begin());
  std::copy(state.ydot.begin(), state.ydot.end(), view(ydot_.get()).begin());
  check(IDAReInit(ida_.get(), state.t, y_.get(), ydot_.get()), "IDAReInit");
  rejected_ = 0;  // IDA's counts start anew
  if (!settings_.integrand) return;
  integrated_ = 0;
  N_VConst(0, integral_.get());
  check(IDAQuadReInit(ida_.get(), integral_.get()), "IDAQuadReInit");
}

/// Passes over a time of the size of rounding errors, for example to an output time right after
/// resuming. IDA refuses such steps. The state does not change, so the integral is zero.
StepReport BdfMemory::skip_to(State& state, double t) {
  const double step = t - state.t;
  state.t = t;
  restart(state);
  if (branch()) state.branch = *branch();
  return {.step = step, .order = 1};
}

/// Counts the attempts that IDA rejected in the last step.
void BdfMemory::count_rejected() {
  long error_fails = 0, newton_fails = 0;
  check(IDAGetNumErrTestFails(ida_.get(), &error_fails), "IDAGetNumErrTestFails");
  check(IDAGetNumStepSolveFails(ida_.get(), &newton_fails), "IDAGetNumStepSolveFails");
  const long rejected = error_fails + newton_fails;
  counters_.rejected_steps += rejected - std::exchange(rejected_, rejected);
}

/// Where the solution ends, steps succeed but become ever smaller. Returns true if this persists.
bool BdfMemory::vanishes(double step) {
  constexpr int many = 20;
  constexpr double tiny =
      1e-12;  // part of the run; a hundred of the shortest steps (stop_rules.hpp)
  const bool tiny_for_a_reason = step < tiny * settings_.end && !guard_.recoverable().empty();
  vanishing_ = tiny_for_a_reason ? vanishing_ + 1 : 0;
  return vanishing_ == many;
}

/// The integral over the step that IDA has just made.
double BdfMemory::take_integral() {
  if (!settings_.integrand) return 0;
  sunrealtype t = 0;
  check(IDAGetQuad(ida_.get(), &t, integral_.get()), "IDAGetQuad");
  const double reached = view(integral_.get())[0];
  return reached - std::exchange(integrated_, reached);
}

/// The latest end of a step from t: where a node has closed recently, two short steps lead to a
/// settled time.
double BdfMemory::settling_stop(const std::optional<Settling>& settling, double t,
                                double t_stop) const {
  if (!settling) return t_stop;
  if (settling->before(t)) return closings_->recent() ? std::min(settling->begin, t_stop) : t_stop;
  return std::min(settling->in_first_step(t) ? settling->middle() : settling->end, t_stop);
}

/// Whether a node has closed in the step from t to `reached`, which has passed the time where
/// settling begins because none had closed before. The step is then taken back, and IDA begins
/// anew: its polynomial cannot lead to that time, because it has worn the node before it closed.
/// (A located closing does not need it: it is at the end of a step.)
bool BdfMemory::needs_settling(const std::optional<Settling>& settling, double t,
                               const State& reached) const {
  return settling && settling->before(t) && !settling->before(reached.t) && !branch() &&
         !closings_->recent() && closings_->closes(active(reached));
}

/// One step of IDA at most to t_stop, in `reached`.
int BdfMemory::step(double t_stop, State& reached) {
  void* ida = ida_.get();
  check(IDASetInitStep(ida, std::exchange(first_step_, 0)), "IDASetInitStep");  // 0: IDA's choice
  check(IDASetStopTime(ida, t_stop), "IDASetStopTime");
  const double t = reached.t;
  const int flag = IDASolve(ida, t_stop, &reached.t, y_.get(), ydot_.get(), IDA_ONE_STEP);
  guard_.rethrow();
  count_rejected();
  if (flag < 0 || vanishes(reached.t - t)) fail(flag, t);
  std::copy(view(y_.get()).begin(), view(y_.get()).end(), reached.y.begin());
  set_rates(*system_, branch(), reached);
  return flag;
}

StepReport BdfMemory::advance(State& state, double t_stop) {
  // Relative distance of two times that are meant to be equal. IDA refuses to begin with a step of
  // a few rounding errors.
  constexpr double nothing = 1e-12;
  from_ = state.t;
  if (!begun_) begin(state);
  guard_.clear();
  std::optional<Settling> settling;
  if (closings_) settling = next_settling(system_->structure(), settings_, state.t);
  t_stop = settling_stop(settling, state.t, t_stop);
  t_stop = end_of_smooth_part(system_->structure(), state.t, t_stop);
  t_stop = end_at_stop(system_->structure(), state.t, t_stop);
  if (t_stop - state.t <= nothing * t_stop) return skip_to(state, t_stop);
  State reached = state;  // an event that cannot be crossed leaves the last good state
  int flag = step(t_stop, reached);
  const auto take_back = [&](double first_step, double stop) {
    ++counters_.rejected_steps;
    restart(state);
    first_step_ = first_step;
    reached = state;
    flag = step(stop, reached);
  };
  if (needs_settling(settling, state.t, reached))
    take_back(settling->begin - state.t, settling->begin);
  if (!branch())
    while (const double shorter = jumps_(state, reached, reached.t - state.t).shorter)
      take_back(shorter, t_stop);
  int order = 0;
  check(IDAGetLastOrder(ida_.get(), &order), "IDAGetLastOrder");
  StepReport report{.step = reached.t - state.t, .order = order, .integral = take_integral()};
  const bool event = branch() && cross_event(reached, flag == IDA_ROOT_RETURN, report);
  const bool breaks = is_breakpoint(system_->structure(), reached.t);
  if (breaks && pass_breakpoint(*system_, counters_, branch(), reached) && branch())
    branch_.emplace(*system_, reached.t, reached.y, settings_.end);
  if (event || breaks) restart(reached);
  if (branch()) reached.branch = *branch();
  if (closings_) closings_->accept(active(reached), settling && !settling->before(state.t));
  state = std::move(reached);
  return report;
}

void BdfMemory::fail(int flag, double t) const {
  const char* what = flag == IDA_ERR_FAIL       ? "the error test failed at the smallest step"
                     : flag == IDA_CONV_FAIL    ? "Newton failed at the smallest step"
                     : flag == IDA_TOO_MUCH_ACC ? "the tolerance is below rounding"
                     : flag < 0                 ? "IDA stopped"
                                                : "steps become too small";
  throw SolutionError(
      fmt::format("bdf cannot continue from t = {:.6g}: {} (code {}){}{}", t, what, flag,
                  guard_.recoverable().empty() ? "" : "; last: ", guard_.recoverable()));
}

const Key& max_order_key() {
  static const Key key = {
      .name = "integrator.max_order",
      .kind = KeyKind::integer,
      .default_value = 5L,
      .range = {.min = 1, .max = 5},
      .help = "highest order",
  };
  return key;
}

}  // namespace gnomon
