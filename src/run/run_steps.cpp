#include <fmt/format.h>

#include <gnomon/run/run_steps.hpp>
#include <utility>

#include "run/bounded_steps.hpp"
#include "run/guards.hpp"
#include "run/store_schedule.hpp"

namespace gnomon {

struct RunSteps::Parts {
  Parts(const Model& first, const Integrator& integrator, IntegratorSettings given,
        std::optional<Until> early)
      : settings(std::move(given)),
        epochs(first),
        until(std::move(early)),
        steps(integrator, settings, until, epochs, observed, memory, counters) {}

  /// Where the model is followed by another one.
  void begin_epoch() {
    if (ended()) return;
    const std::optional<Epochs::Change> change = epochs.succeed(memory.state);
    if (!change) return;
    watch_model();
    steps.follow(change->same_unknowns);
  }
  bool ended() const {
    return memory.state.t >= settings.end || (until && excess(*until, observed) >= 0);
  }
  void watch_model() {
    settings.integrand = epochs.model().wear_flux;
    settings.behind_jump = epochs.model().behind_jump;
  }

  IntegratorSettings settings;
  Epochs epochs;
  std::optional<Until> until;
  Observation observed;
  RunMemory memory;
  Counters counters;
  BoundedSteps steps;
  std::optional<Limit> limit;  // at which the last step has ended
};

RunSteps::RunSteps(const Model& model, const Integrator& integrator, IntegratorSettings settings,
                   std::optional<Until> until)
    : parts_(std::make_unique<Parts>(model, integrator, std::move(settings), std::move(until))) {
  Parts& of = *parts_;
  of.memory.state = model.start(of.counters);
  of.epochs.replace_overdue(of.memory.state);
  of.watch_model();
  of.observed = of.steps.observe({});
  if (of.until) excess(*of.until, of.observed);  // refuses an unknown one
  if (const Model& present = of.epochs.model(); present.overdue && present.overdue(of.memory.state))
    of.begin_epoch();
  of.steps.begin();
}

RunSteps::~RunSteps() = default;

StepReport RunSteps::advance(double stop) {
  Parts& of = *parts_;
  if (ended())
    throw InputError(fmt::format("t = {}: expected no further step after {}", state().t,
                                 of.until ? "time.until or time.end" : "time.end"));
  if (of.limit) throw at_limit(of.memory.state.t, *of.limit);
  BoundedStep step = of.steps.advance(stop, [] { return false; });
  try {
    require_sound_mesh(step.observed);
  } catch (const SolutionError&) {
    of.memory.state = step.before;
    throw;
  }
  of.observed = std::move(step.observed);
  of.limit = std::move(step.limit);
  of.begin_epoch();
  return step.report;
}

bool RunSteps::ended() const {
  return parts_->ended();
}
const State& RunSteps::state() const {
  return parts_->memory.state;
}
const Counters& RunSteps::counters() const {
  return parts_->counters;
}
std::shared_ptr<const Model> RunSteps::successor() const {
  return parts_->epochs.successor();
}

}  // namespace gnomon
