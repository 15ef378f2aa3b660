// One run: a model integrated from its start to time.end, observed and stored on the way.
#pragma once

#include <functional>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Which steps have their fields stored, beside the start.
struct StorePolicy {
  long every = 0;             ///< every n-th step; 0: none
  std::vector<double> times;  ///< at these times, ascending, in (0, end]
  bool last = true;           ///< at the end of the run
  /// A checkpoint (Checkpoint) is written at the start, at the end, and after the step with which
  /// this many steps and Newton iterations have been made since the last; 0: none. There a one-step
  /// method is started anew, so that a run that goes on from it takes the same steps.
  long checkpoint_work = 0;
};

/// The `output.*` keys. Throws InputError for a time beyond time.end.
StorePolicy store_policy(const Scene& scene);

/// Throws InputError when two of the ascending times, on which a run is to land, are nearer than
/// 1e-5 of themselves: in a step that short the change of the shape drowns in rounding. `where`
/// they were given.
void require_apart(const std::vector<double>& times, const std::string& where);

/// The integrator that the scene names. Throws InputError for an unknown one, and for keys that it
/// does not take.
const Integrator& chosen_integrator(const Scene& scene);

/// The `integrator.*` keys, with what absent ones mean.
IntegratorSettings integrator_settings(const Scene& scene, const Model& model);

/// How a run ended.
struct RunOutcome {
  enum class Status { finished, interrupted, failed };
  Status status = Status::finished;
  std::string diagnosis;           ///< when failed
  std::optional<HistoryRow> last;  ///< of the last good state; none when the start itself failed
  Counters counters;               ///< work of the whole run, failed attempts included
  double wall_seconds = 0;
  /// Contact nodes that left contact twice or more between two breakpoints of the load: an oscillation.
  long chattering_nodes = 0;
  /// What the run has warned of, a line each: why its numbers may be worthless.
  std::vector<std::string> warnings;

  /// "finished", "interrupted", "failed: DIAGNOSIS"; what the result file and the summary say.
  std::string text() const;
};

struct RunHooks {
  /// Called after the start and after every step.
  std::function<void(const HistoryRow&)> on_step = [](const HistoryRow&) {};
  /// Called with every one of RunOutcome::warnings, when there is a reason for it.
  std::function<void(const std::string&)> on_warning = [](const std::string&) {};
  /// Asked after the start and after every step; true ends the run there.
  std::function<bool()> interrupted = [] { return false; };
};

/// Where an earlier run stopped, for one that goes on from there.
struct Resumption {
  Checkpoint checkpoint;
  HistoryRow row;                ///< of the history at the checkpoint
  std::optional<double> stored;  ///< time of the last step stored by then
  double wall_seconds = 0;       ///< spent so far
};

/// The state that a checkpoint was made at. Throws InputError when it is not one of the model.
State state_at(const Checkpoint& checkpoint, const Model& model);

/// Integrates, from the start or from a checkpoint. Everything goes to `writer` (null: nowhere) as
/// it is computed, and its close() is called whatever happens. A SolutionError ends the run with
/// status failed, the last good state stored; other exceptions pass through, InputError for a
/// checkpoint of another model among them.
RunOutcome run(const Model& model, const Integrator& integrator, const IntegratorSettings& settings,
               const StorePolicy& policy, ResultWriter* writer, const RunHooks& hooks,
               const Resumption* from = nullptr);

}  // namespace gnomon
