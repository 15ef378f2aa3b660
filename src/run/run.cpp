#include <chrono>
#include <gnomon/error.hpp>
#include <gnomon/run.hpp>

#include "run/flicker.hpp"
#include "run/instability.hpp"
#include "run/mesh_watch.hpp"
#include "run/store_schedule.hpp"
#include "run/wear_integral.hpp"

namespace gnomon {

namespace {

using Status = RunOutcome::Status;

class Runner {
public:
  Runner(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
         const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks)
      : model_(model),
        integrator_(integrator),
        settings_(settings),
        schedule_(policy, settings.end),
        writer_(writer),
        hooks_(hooks),
        watches_damping_(settings.stop_unstable && may_fail_to_damp(integrator, settings)) {}

  RunOutcome operator()() {
    try {
      outcome_.status = integrate();
    } catch (const SolutionError& error) {
      outcome_.status = Status::failed;
      outcome_.diagnosis = error.what();
    } catch (const std::exception& error) {
      close_quietly(error.what());
      throw;
    }
    // The last good state is worth keeping whatever the scene asked to store of a regular run.
    if (outcome_.status != Status::finished && outcome_.last) store();
    outcome_.wall_seconds = elapsed();
    outcome_.counters = counters_;
    outcome_.flickering_nodes = flicker_.nodes();
    if (outcome_.last) outcome_.warning = mesh_warning(outcome_.last->scalars);
    if (writer_) writer_->close(outcome_.text(), outcome_.wall_seconds);
    return outcome_;
  }

private:
  Status integrate() {
    state_ = model_.start(counters_);
    record({});
    store();
    if (hooks_.interrupted()) return Status::interrupted;
    if (watches_damping_) require_damping(model_, integrator_, settings_, state_);
    const auto stepper = integrator_.make(model_, settings_, counters_);
    while (state_.t < settings_.end) {
      if (hooks_.interrupted()) return Status::interrupted;
      const StepReport report = stepper->advance(state_, schedule_.stop());
      record(report);
      require_sound_mesh(outcome_.last->scalars);
      if (watches_damping_) require_no_flicker(flicker_.nodes(), integrator_);
      if (schedule_.wants(state_.t, counters_.steps)) store();
    }
    // What touched in one node at the start had no fast mode there.
    if (watches_damping_) require_damping(model_, integrator_, settings_, state_);
    return Status::finished;
  }

  void record(const StepReport& report) {
    HistoryRow row{state_.t, report, counters_, model_.observe(state_)};
    wear_integral_.append_to(row.scalars, state_.t);
    flicker_.add(model_.contact(state_));
    if (writer_) writer_->append(row);
    outcome_.last = std::move(row);
    hooks_.on_step(*outcome_.last);
  }

  void store() {
    if (stored_ && stored_at_ == state_.t) return;
    if (writer_) writer_->store(state_.t, model_.fields(state_), model_.contact(state_));
    stored_ = true;
    stored_at_ = state_.t;
  }

  /// On the way out with an exception, which matters more than one from here.
  void close_quietly(const std::string& reason) noexcept {
    try {
      if (writer_) writer_->close("failed: " + reason, elapsed());
    } catch (const std::exception&) {
    }
  }

  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  const Model& model_;
  const Integrator& integrator_;
  const IntegratorSettings& settings_;
  StoreSchedule schedule_;
  ResultWriter* writer_;
  const RunHooks& hooks_;
  const bool watches_damping_;

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Counters counters_;
  State state_;
  WearIntegral wear_integral_;
  Flicker flicker_;
  RunOutcome outcome_;
  bool stored_ = false;
  double stored_at_ = 0;
};

}  // namespace

std::string RunOutcome::text() const {
  switch (status) {
    case Status::finished:
      return "finished";
    case Status::interrupted:
      return "interrupted";
    case Status::failed:
      return "failed: " + diagnosis;
  }
  return {};
}

RunOutcome run(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
               const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks) {
  return Runner(model, integrator, settings, policy, writer, hooks)();
}

}  // namespace gnomon
