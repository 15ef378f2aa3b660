#include "run/run_store.hpp"

namespace gnomon {

void RunStore::resume(const Resumption& from) {
  last_checkpoint_ = from.checkpoint;
  checkpoint_rows_ = from.checkpoint.rows;
  stored_at_ = from.stored;
  earlier_seconds_ = from.wall_seconds;
}

void RunStore::append(const HistoryRow& row) {
  if (writer_) writer_->append(row);
  ++last_checkpoint_.rows;
}

void RunStore::store(const Model& model, const State& state) {
  if (stored_at_ == state.t) return;
  if (writer_) {
    std::optional<CounterSurface> counter_surface;
    if (model.counter_surface) counter_surface = model.counter_surface(state);
    writer_->store(state.t, model.fields(state), model.contact(state), counter_surface);
  }
  ++last_checkpoint_.stored;
  stored_at_ = state.t;
}

void RunStore::begin_epoch(EpochStart start, long number, const Model& model) {
  start.rows = last_checkpoint_.rows;
  start.stored = last_checkpoint_.stored;
  last_checkpoint_.epoch = number;
  if (writer_) writer_->begin_epoch(start, model.grid);
}

bool RunStore::checkpoint_is_due() const {
  const std::chrono::duration<double> passed = Clock::now() - checkpointed_;
  return policy_.checkpoint_seconds > 0 && passed.count() >= policy_.checkpoint_seconds;
}

void RunStore::checkpoint(const RunMemory& memory, const Structure& structure) {
  ++last_checkpoint_.number;
  last_checkpoint_.numbers = packed(memory, structure);
  if (writer_) writer_->checkpoint(last_checkpoint_);
  checkpoint_rows_ = last_checkpoint_.rows;
  checkpointed_ = Clock::now();
}

void RunStore::abandon(const std::string& reason) noexcept {
  try {
    if (writer_) writer_->abandon(reason, elapsed());
  } catch (const std::exception&) {
  }
}

double RunStore::elapsed() const {
  return earlier_seconds_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

}  // namespace gnomon
