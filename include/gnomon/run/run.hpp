// One run: a model integrated from its start to time.end, observed and stored on the way.
#pragma once

#include <functional>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// The end of a run before time.end: where an observation rises above a value, or falls below it.
struct Until {
  std::string text;         ///< "wear_depth > 1.0"
  std::string where;        ///< beginning of a message about it
  std::string observation;  ///< its name in the history
  bool above = true;
  double value = 0;
};

/// The steps whose fields are stored, in addition to the start and the end.
struct StorePolicy {
  long every = 0;                   ///< every n-th step; 0: none
  std::vector<double> times = {};   ///< at these times, ascending, in (0, end]
  std::vector<double> beyond = {};  ///< times of the scene after the end, ascending: not stored
  /// Wall time after which a checkpoint (Checkpoint) follows the start or a step [s]; 0: none. One
  /// more is written where the run ends or is interrupted (RunHooks). They do not change the run.
  double checkpoint_seconds = 0;
  /// Ends the run early. The step with which it holds is shortened to about where it begins to, to
  /// a thousandth of this step.
  std::optional<Until> until = {};
  /// Of a cycle: the error of the mean over its phases is estimated at the start and at the end.
  bool phase_errors = false;
  /// The one above which the user is warned of it; nothing: the tolerance of the steps, a fixed
  /// figure where they have none.
  std::optional<double> phase_tolerance{};
  /// Whether the state at the end is examined, of which the user is warned.
  bool examine_end = true;
};

/// What the keys of output and time.until ask for. Throws InputError for times that are too close
/// or too many.
StorePolicy store_policy(const Scene& scene);

/// What the user should know of the times that the scene asks for: in one line, or empty.
std::string dropped_times_text(const Scene& scene);

/// Throws InputError if two of the ascending times, at which steps have to end, are closer than
/// 1e-5 of their value: in so short a step the change of the shape is smaller than rounding errors.
/// `where`: where the times were given.
void require_apart(const std::vector<double>& times, const std::string& where);

/// The integrator that the scene names. Throws InputError for an unknown one, and for keys that it
/// does not accept.
const Integrator& chosen_integrator(const Scene& scene);

/// What the keys of the integrator say, with the meaning of absent ones, and the times at which
/// pressures shall have settled: those of the stored states, if the integrator settles them.
IntegratorSettings integrator_settings(const Scene& scene, const Model& model);

/// How a run ended.
struct RunOutcome {
  enum class Status { finished, interrupted, failed };
  Status status = Status::finished;
  std::string diagnosis;           ///< when failed
  std::string ended_by;            ///< when finished: "time.end", "time.until: wear_depth > 1.0"
  std::optional<HistoryRow> last;  ///< of the last good state; absent if the start failed
  std::optional<State> state;      ///< the last good one; absent if the start failed
  /// That of `state` where the run came to a later epoch; else null, and it is the one given.
  std::shared_ptr<const Model> successor;
  long epochs = 1;    ///< that the run has had
  long restarts = 0;  ///< of a method of several steps, where an epoch began
  Counters counters;  ///< work of the whole run, including failed attempts
  double wall_seconds = 0;
  /// Contact nodes that left contact twice or more between two breakpoints of the load: an
  /// oscillation.
  long chattering_nodes = 0;
  /// Of a cycle: the errors of the mean over its phases, at the start and at the end.
  std::vector<PhaseError> phase_errors;
  Examination examination;  ///< of the last good state
  /// EndJudgement::budget of a finished run; empty: nothing.
  std::string budget;
  /// The warnings of the run, one line each: reasons why its numbers may be worthless.
  std::vector<std::string> warnings;

  /// "finished", "finished: wear_depth > 1.0", "interrupted", "failed: DIAGNOSIS", as in the result
  /// file.
  std::string text() const;
};

/// What is said of a finished run.
struct EndJudgement {
  std::string budget{};  ///< its error budget as JSON, which the result keeps; empty: there is none
  std::vector<std::string> warnings{};
};

struct RunHooks {
  /// Called after the start and after every step.
  std::function<void(const HistoryRow&)> on_step = [](const HistoryRow&) {};
  /// Called with the model of every epoch but the first, before its states.
  std::function<void(const std::shared_ptr<const Model>&)> on_epoch =
      [](const std::shared_ptr<const Model>&) {};
  /// Called with the state before each of these calls.
  std::function<void(const State&)> on_state = [](const State&) {};
  /// Called with each of RunOutcome::warnings when it arises.
  std::function<void(const std::string&)> on_warning = [](const std::string&) {};
  /// Called with the model and the last state of a finished run, and their observation, before the
  /// result is closed.
  std::function<EndJudgement(const Model&, const State&, const Observation&)> judge{};
  /// Called after the start and every step, and within steps; true ends the run at the last one.
  std::function<bool()> interrupted = [] { return false; };
  /// Also within the start or a step; more fail.
  long most_newton_iterations = std::numeric_limits<long>::max();
};

/// The point at which an earlier run stopped, for a run that continues from there.
struct Resumption {
  Checkpoint checkpoint;
  HistoryRow row;                          ///< of the history at the checkpoint
  std::optional<double> stored{};          ///< time of the last stored step up to the checkpoint
  double wall_seconds = 0;                 ///< spent so far
  std::vector<PhaseError> phase_errors{};  ///< at the start
  std::vector<EpochStart> epochs{};        ///< that have begun up to the checkpoint
};

/// The model of an epoch, made again from the states at which epochs began; null for the first.
/// Throws InputError if it is not that of the result.
std::shared_ptr<const Model> model_of_epoch(const Model& first, std::span<const EpochStart> begun);
/// The state of a checkpoint. Throws InputError if it is not a state of the model of its epoch.
State state_at(const Checkpoint& checkpoint, const Model& model);

/// Integrates, from the start or from a checkpoint. Everything is given to `writer` (may be null)
/// as it is computed, and its close() is called in every case. A SolutionError ends the run with
/// status failed, the last good state stored; other exceptions pass through, InputError for a
/// checkpoint of another model among them.
RunOutcome run(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
               const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks,
               const Resumption* from = nullptr);

}  // namespace gnomon
