// bdf: variable-step, variable-order backward differentiation by IDA, with a semismooth Newton
// solver inside.

#include <algorithm>
#include <gnomon/integrators/closings.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/scene/keys.hpp>

#include "integrators/ida.hpp"

namespace gnomon {

namespace {

const Key max_order_key =
    integer_key("integrator.max_order", by_default(5L), {.min = 1, .max = 5}, "highest order");

class BdfSolver : public Stepper {
public:
  BdfSolver(const System& system, const IntegratorSettings& settings, Counters& counters)
      : Stepper(counters),
        system_(system),
        settings_(settings),
        counters_(counters),
        norm_(system.structure(), settings),
        ida_(std::make_unique<Ida>(system, settings, counters)) {}

  /// IDA keeps its history where the unknowns are the same; it cannot be given others.
  bool follow(Stepper& before, const State&, bool same) override {
    auto& earlier = dynamic_cast<BdfSolver&>(before);
    if (!same || !earlier.ida_->begun()) return !earlier.ida_->begun();
    ida_ = std::move(earlier.ida_);
    ida_->adopt(system_, settings_);
    closings_ = std::move(earlier.closings_);
    return true;
  }

private:
  StepReport take_step(State& state, double t_stop) override {
    // Relative distance of two times that are meant to be equal. IDA refuses to begin with a step
    // of a few rounding errors.
    constexpr double nothing = 1e-12;
    const Structure& structure = system_.structure();
    if (!ida_->begun()) begin(state);
    std::optional<Settling> settling;
    if (closings_) settling = next_settling(structure, settings_, state.t);
    t_stop = settling_stop(settling, state.t, t_stop);
    t_stop = end_of_smooth_part(structure, state.t, t_stop);
    t_stop = end_at_stop(structure, state.t, t_stop);
    if (t_stop - state.t <= nothing * t_stop) return skip_to(state, t_stop);
    State reached = state;  // an event that cannot be crossed leaves the last good state
    bool at_root = ida_->step(t_stop, 0, reached);
    const auto take_back = [&](double first_step, double stop) {
      ++counters_.rejected_steps;
      ida_->restart(state);
      reached = state;
      at_root = ida_->step(stop, first_step, reached);
    };
    if (needs_settling(settling, state.t, reached))
      take_back(settling->begin - state.t, settling->begin);
    if (!branch())
      while (const double shorter =
                 error_of_jumps(system_, norm_, state, reached, reached.t - state.t).shorter)
        take_back(shorter, t_stop);
    StepReport report{
        .step = reached.t - state.t, .order = ida_->order(), .integral = ida_->take_integral()};
    const bool event = branch() && cross_event(reached, at_root, report);
    const bool breaks = is_breakpoint(structure, reached.t);
    if (breaks && pass_breakpoint(system_, settings_, counters_, branch(), reached) && branch())
      ida_->locate(reached);
    if (event || breaks) ida_->restart(reached);
    if (branch()) reached.branch = *branch();
    if (closings_) closings_->accept(active(reached), settling && !settling->before(state.t));
    state = std::move(reached);
    return report;
  }

  void begin(const State& state) {
    constexpr int steps_to_damp = 5;  // that a closing needs
    ida_->begin(state, static_cast<int>(std::get<long>(settings_.value(max_order_key))));
    if (!settings_.settled.empty()) closings_.emplace(steps_to_damp).begin(active(state));
  }

  /// At an event the state is made consistent on the branch after the event. Returns false if there
  /// is no event.
  bool cross_event(State& state, bool at_root, StepReport& report) {
    report.switched = ida_->switch_nodes(state, at_root);
    if (report.switched == 0) return false;
    ++counters_.events;
    if (!algebraic_) algebraic_.emplace(system_, counters_);
    const std::string reason = algebraic_->solve(state.t, state.y, branch());
    if (!reason.empty()) throw SolutionError("bdf, after an event: " + reason);
    set_rates(system_, branch(), state);
    return true;
  }

  /// Passes over a time of the size of rounding errors, for example to an output time right after
  /// resuming. IDA refuses such steps. The state does not change, so the integral is zero.
  StepReport skip_to(State& state, double t) {
    const double step = t - state.t;
    state.t = t;
    ida_->restart(state);
    if (branch()) state.branch = *branch();
    return {.step = step, .order = 1};
  }

  /// The latest end of a step from t: where a node has closed recently, two short steps lead to a
  /// settled time.
  double settling_stop(const std::optional<Settling>& settling, double t, double t_stop) const {
    if (!settling) return t_stop;
    if (settling->before(t))
      return closings_->recent() ? std::min(settling->begin, t_stop) : t_stop;
    return std::min(settling->in_first_step(t) ? settling->middle() : settling->end, t_stop);
  }

  /// Whether a node has closed in the step from t to `reached`, which has passed the time where
  /// settling begins because none had closed before. The step is then taken back, and IDA begins
  /// anew: its polynomial cannot lead to that time, because it has worn the node before it closed.
  /// (A located closing does not need it: it is at the end of a step.)
  bool needs_settling(const std::optional<Settling>& settling, double t,
                      const State& reached) const {
    return settling && settling->before(t) && !settling->before(reached.t) && !branch() &&
           !closings_->recent() && closings_->closes(active(reached));
  }

  const ActiveSet* branch() const { return ida_->branch(); }
  ActiveSet active(const State& state) const {
    return branch() ? *branch() : active_set(system_, state.t, state.y);
  }

  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ErrorNorm norm_;
  std::optional<Closings> closings_;          // only with settled times
  std::optional<AlgebraicSolver> algebraic_;  // made at the first event
  std::unique_ptr<Ida> ida_;
};

const Registration<Integrator> registration({
    .name = "bdf",
    .family = "implicit multistep",
    .order = "1-5",
    .error_estimate = "predictor-corrector",
    .stability = "A and L at orders 1-2, A(alpha) at 3-5",
    .driver = "IDA",
    .help = "variable step and order, error control on the worn surface (integrator.rtol, .atol)",
    .fixed_steps = false,
    .keys = {max_order_key},
    .table = [](const IntegratorSettings&) { return std::nullopt; },
    .make = [](const System& system, const IntegratorSettings& settings,
               Counters& counters) -> std::unique_ptr<Stepper> {
      return std::make_unique<BdfSolver>(system, settings, counters);
    },
});

}  // namespace

}  // namespace gnomon
