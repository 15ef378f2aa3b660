#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/interruption.hpp>
#include <gnomon/run/run.hpp>
#include <set>

#include "run/bounded_steps.hpp"
#include "run/guards.hpp"
#include "run/jump_ledger.hpp"
#include "run/memory.hpp"
#include "run/run_store.hpp"
#include "run/store_schedule.hpp"

namespace gnomon {

namespace {

using Status = RunOutcome::Status;

class Runner {
public:
  Runner(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
         const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks)
      : epochs_(model),
        integrator_(integrator),
        settings_(settings),
        policy_(policy),
        schedule_(policy, settings.end),
        store_(policy, writer),
        hooks_(hooks),
        steps_(integrator, settings_, policy.until, epochs_, observed_, memory_, counters_) {
    counters_.most_newton_iterations = hooks.most_newton_iterations;
    watch_model();
  }

  RunOutcome operator()(const Resumption* from) {
    try {
      from ? resume(*from) : start();
      outcome_.status = integrate();
    } catch (const Interruption&) {  // of the start
      outcome_.status = Status::interrupted;
    } catch (const SolutionError& error) {
      fail(error);
    } catch (const RecoverableError& error) {  // of a state that no solver has proposed: the start
      fail(error);
    } catch (const std::exception& error) {
      store_.abandon(std::string("failed: ") + error.what());
      throw;
    }
    if (outcome_.last && policy_.examine_end) examine_end();
    if (outcome_.status != Status::failed && outcome_.last)
      for (const std::string& text :
           end_warnings(observed_, invisible_volume(model().grid, dimension_of(observed_)),
                        memory_.chattering.nodes(), integrator_, settings_))
        warn(text);
    if (const std::string text = jumps_->warning(state()); !text.empty()) warn(text);
    // The last good state is always stored, independent of the output keys of the scene.
    if (outcome_.status != Status::finished && outcome_.last) store_.store(model(), state());
    if (outcome_.status == Status::finished)
      outcome_.ended_by = ends_early() ? "time.until: " + policy_.until->text : "time.end";
    outcome_.wall_seconds = store_.elapsed();
    if (outcome_.status == Status::finished && hooks_.judge) judge();
    outcome_.counters = counters_;
    outcome_.chattering_nodes = memory_.chattering.nodes();
    store_.close(outcome_.text(), outcome_.wall_seconds);
    if (outcome_.last) outcome_.state = std::move(state());
    outcome_.successor = epochs_.successor();
    outcome_.epochs = epochs_.number() + 1;
    return std::move(outcome_);
  }

private:
  void fail(const Error& error) {
    outcome_.status = Status::failed;
    outcome_.diagnosis = error.what() + jumps_->suspicion(state());
  }

  void judge() {
    const EndJudgement judgement = hooks_.judge(model(), state(), observed_);
    outcome_.budget = judgement.budget;
    store_.write_budget(outcome_.budget);
    for (const std::string& text : judgement.warnings) warn(text);
  }

  void start() {
    {
      const Interruptible here(hooks_.interrupted);
      state() = model().start(counters_);
    }
    replace_overdue();
    Observation observed = steps_.observe({});
    if (policy_.until) excess(*policy_.until, observed);  // refuses an unknown one
    record({}, std::move(observed));
    store_.store(model(), state());
    outcome_.examination = examined();
    require_model(outcome_.examination);
    for (const std::string& text : doubts(outcome_.examination)) warn("at the start " + text);
    if (const std::string text = doubt_about_few_nodes(outcome_.examination); !text.empty())
      warn(text);
    if (hooks_.interrupted()) return;
    estimate_phase_error();
    steps_.begin();
    if (store_.checkpoint_is_due()) checkpoint();
  }

  /// Without an epoch: at the start, and where a resumed run goes on, whose model is made as that
  /// was.
  void replace_overdue() {
    if (!epochs_.replace_overdue(state())) return;
    watch_model();
    hooks_.on_epoch(epochs_.successor());
  }

  /// What looks at the steps of the model of this epoch.
  void watch_model() {
    settings_.integrand = model().wear_flux;
    settings_.behind_jump = model().behind_jump;
    initial_quality_ = initial_quality(model().grid);
    jumps_.emplace(model().system(), settings_);
    if (settings_.stop_unstable && may_fail_to_damp(integrator_, settings_))
      damping_.emplace(model(), integrator_, settings_);
  }

  void resume(const Resumption& from) {
    epochs_.repeat(from.epochs);
    watch_model();
    if (epochs_.successor()) hooks_.on_epoch(epochs_.successor());
    memory_ = unpacked(from.checkpoint.numbers, model().system().structure());
    if (state().t != from.row.t)
      throw InputError("the time of the checkpoint is not that of its row in the history");
    replace_overdue();
    counters_ = from.row.counters;
    observed_ = from.row.scalars;
    outcome_.phase_errors = from.phase_errors;
    for (const PhaseError& at_start : from.phase_errors) judge_phases(at_start);
    outcome_.last = from.row;
    store_.resume(from);
    schedule_.wants(state().t, counters_.steps);  // everything up to here is already stored
  }

  Status integrate() {
    if (damping_) damping_->require_damping_in_wider_contact(state(), observed_);
    ProgressWatch progress(state().t, counters_, settings_.end);
    if (model().overdue && model().overdue(state())) begin_epoch();
    while (state().t < settings_.end && !ends_early()) {
      if (hooks_.interrupted()) {
        checkpoint_news();
        return Status::interrupted;
      }
      BoundedStep step;
      try {
        step = steps_.advance(schedule_.stop(), hooks_.interrupted);
      } catch (const Interruption&) {
        if (store_.has_news()) store_.checkpoint(memory_, model().system().structure());
        return Status::interrupted;
      }
      jumps_->add(step.before, state());
      require_mesh(step.observed, step.before);
      record(step.report, std::move(step.observed));
      progress.require(state().t, counters_);
      if (damping_) {
        damping_->require_damping_in_wider_contact(state(), observed_);
        require_no_chattering(memory_.chattering.nodes(), integrator_);
      }
      if (schedule_.wants(state().t, counters_.steps) || ends_early())
        store_.store(model(), state());
      if (step.limit && !ends_early()) throw at_limit(state().t, *step.limit);
      begin_epoch();
      if (store_.checkpoint_is_due()) checkpoint();
    }
    checkpoint_news();
    if (damping_) judge_damping();
    steps_.end();  // its memory is needed
    estimate_phase_error();
    return Status::finished;
  }

  Examination examined() { return model().examine ? model().examine(state()) : Examination{}; }

  /// What the last state says, but for what was said of the start.
  void examine_end() {
    const Examination start = std::move(outcome_.examination);
    const std::vector<std::string> before = doubts(start);
    outcome_.examination = examined();
    for (const std::string& text : doubts(start, outcome_.examination)) warn(text);
    for (const std::string& text : doubts(outcome_.examination))
      if (std::ranges::find(before, text) == before.end()) warn("at the end " + text);
  }

  /// Where the model is followed by another one.
  void begin_epoch() {
    if (state().t >= settings_.end || ends_early()) return;
    std::optional<Epochs::Change> change = epochs_.succeed(state());
    if (!change) return;
    watch_model();
    hooks_.on_epoch(epochs_.successor());
    if (!change->same_unknowns) {
      memory_.chattering = {};
      memory_.chattering.add(model().contact(state()));
    }
    outcome_.restarts += !steps_.follow(change->same_unknowns);
    store_.begin_epoch(std::move(change->start), epochs_.number(), model());
    if (steps_.have_begun() && store_.keeps_checkpoints()) checkpoint();
  }

  /// Whether the last good state is the last one of the run, by time.until.
  bool ends_early() const { return policy_.until && excess(*policy_.until, observed_) >= 0; }

  void warn(const std::string& text) {
    outcome_.warnings.push_back(text);
    hooks_.on_warning(text);
  }

  void judge_damping() {
    damping_->require_damping(state());
    if (!damping_->has_seen_a_mode() && model().contact(state()))
      warn(fmt::format(
          "no step ended with a decaying mode (contact at a single node has none) that would show "
          "whether steps of {:g} s are short enough for {}",
          settings_.step, integrator_.name));
  }

  void record(const StepReport& report, Observation observed) {
    observed_ = std::move(observed);
    HistoryRow row{state().t, report, counters_, observed_};
    memory_.chattering.add(model().contact(state()));
    if (is_breakpoint(model().system().structure(), state().t)) memory_.chattering.begin_anew();
    store_.append(row);
    outcome_.last = std::move(row);
    hooks_.on_state(state());
    hooks_.on_step(*outcome_.last);
  }

  /// A state with an unusable mesh is not kept: the run ends with the state before it.
  void require_mesh(const Observation& observed, const State& before) {
    try {
      require_sound_mesh(observed);
    } catch (const SolutionError&) {
      state() = before;
      throw;
    }
    for (const MeshWarning& warning : mesh_warnings(observed, initial_quality_))
      if (warned_of_.insert(warning.about).second)
        warn(fmt::format("at t = {:g} s {}", state().t, warning.text));
  }

  std::string unknown_phase_error(const char* reason) const {
    return fmt::format("the error of the mean over the phases at t = {:g} s is not known: {}",
                       memory_.state.t, reason);
  }

  void judge_phases(const PhaseError& at_start) {
    const double of_steps = settings_.step > 0 ? phase_tolerance_of_fixed_steps : settings_.rtol;
    const double tolerance = policy_.phase_tolerance.value_or(of_steps);
    if (const std::string text = phase_warning(at_start, tolerance); !text.empty()) warn(text);
  }

  /// Beside the run: its steps and its counters are the same without it.
  void estimate_phase_error() {
    if (!policy_.phase_errors || !model().phase_error) return;
    try {
      const std::optional<PhaseError> error = model().phase_error(state());
      if (!error) return;
      store_.append(*error);
      outcome_.phase_errors.push_back(*error);
      if (state().t == 0) judge_phases(*error);
    } catch (const SolutionError& error) {
      warn(unknown_phase_error(error.what()));
    } catch (const InputError& error) {
      warn(unknown_phase_error(error.what()));
    }
  }

  /// So that no step is lost. A run that goes on from here restarts its method where the
  /// uninterrupted one did not.
  void checkpoint_news() {
    if (steps_.have_begun() && store_.has_news()) checkpoint();
  }

  void checkpoint() {
    steps_.remember();
    store_.checkpoint(memory_, model().system().structure());
  }

  State& state() { return memory_.state; }
  const Model& model() const { return epochs_.model(); }

  Epochs epochs_;
  const Integrator& integrator_;
  IntegratorSettings settings_;
  const StorePolicy& policy_;
  StoreSchedule schedule_;
  RunStore store_;
  const RunHooks& hooks_;

  Counters counters_;
  RunMemory memory_;
  std::optional<DampingWatch> damping_;
  std::optional<JumpLedger> jumps_;
  double initial_quality_ = 0;  // of the mesh at the beginning of the epoch
  Observation observed_;        // of the last good state
  BoundedSteps steps_;
  RunOutcome outcome_;
  std::set<std::string> warned_of_;
};

}  // namespace

RunOutcome run(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
               const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks,
               const Resumption* from) {
  return Runner(model, integrator, settings, policy, writer, hooks)(from);
}

}  // namespace gnomon
