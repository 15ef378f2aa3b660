// What a run leaves in its result: the history, stored steps, checkpoints and epochs. Without a
// writer they are counted alone.
#pragma once

#include <chrono>
#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/run/run.hpp>
#include <optional>
#include <string>

#include "run/memory.hpp"

namespace gnomon {

class RunStore {
public:
  RunStore(const StorePolicy& policy, ResultWriter* writer) : policy_(policy), writer_(writer) {}

  void resume(const Resumption& from);

  void append(const HistoryRow& row);
  void append(const PhaseError& error) {
    if (writer_) writer_->append_phase_error(error);
  }
  /// Once for each time.
  void store(const Model& model, const State& state);
  /// With the model of the epoch. `start`: without its place in the result.
  void begin_epoch(EpochStart start, long number, const Model& model);
  void write_budget(const std::string& budget) {
    if (writer_ && !budget.empty()) writer_->write_budget(budget);
  }

  /// Whether there is a result that gets checkpoints, one at the beginning of every epoch, too.
  bool keeps_checkpoints() const { return writer_ && policy_.checkpoint_seconds > 0; }
  /// By the clock.
  bool checkpoint_is_due() const;
  /// Whether there are rows that no checkpoint has.
  bool has_news() const { return checkpoint_rows_ != last_checkpoint_.rows; }
  void checkpoint(const RunMemory& memory, const Structure& structure);

  /// `seconds`: wall time of the integration.
  void close(const std::string& text, double seconds) {
    if (writer_) writer_->close(text, seconds);
  }
  /// Called while an exception is propagated; further exceptions are ignored.
  void abandon(const std::string& reason) noexcept;
  /// Wall time, with that before it was resumed [s].
  double elapsed() const;

private:
  using Clock = std::chrono::steady_clock;

  const StorePolicy& policy_;
  ResultWriter* writer_;
  const Clock::time_point begin_ = Clock::now();
  double earlier_seconds_ = 0;
  std::optional<double> stored_at_;
  Checkpoint last_checkpoint_{
      -1, 0, 0, {}, 0};                      // with the present numbers of rows and stored steps
  long checkpoint_rows_ = 0;                 // rows at the last checkpoint that was written
  Clock::time_point checkpointed_ = begin_;  // when the last one was written
};

}  // namespace gnomon
