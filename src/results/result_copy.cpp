#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/results/results.hpp>
#include <span>

namespace gnomon {

namespace {

void copy_step(const ResultReader& from, std::size_t step, double t,
               const std::vector<std::string>& fields, ResultWriter& to) {
  std::vector<GridField> values;
  for (const std::string& field : fields) values.push_back(from.field(step, field));
  to.store(t, values, from.has_contact() ? std::optional(from.contact(t)) : std::nullopt,
           from.counter_surface(step));
}

/// Called before anything is written: with a time that is too late the copy would replace the
/// result.
void require_together(std::span<const HistoryRow> history, std::span<const double> stored) {
  const auto damaged = [](const char* how) {
    throw InputError(fmt::format("the result to continue from is damaged: {}", how));
  };
  std::size_t step = 0;
  for (std::size_t row = 0; row < history.size(); ++row) {
    if (row > 0 && !(history[row].t > history[row - 1].t))
      damaged("the times of its history do not increase");
    step += step < stored.size() && stored[step] == history[row].t;
  }
  if (step != stored.size()) damaged("its stored steps are not at the times of its history");
}

}  // namespace

std::vector<PhaseError> start_errors(const ResultReader& from) {
  std::vector<PhaseError> errors = from.phase_errors();
  std::erase_if(errors, [](const PhaseError& error) { return error.t > 0; });
  return errors;
}

void copy_to_last_checkpoint(const ResultReader& from, const std::vector<std::string>& fields,
                             ResultWriter& to) {
  const std::vector<Checkpoint> checkpoints = from.checkpoints();
  const auto rows = static_cast<std::size_t>(checkpoints.back().rows);
  const auto steps = static_cast<std::size_t>(checkpoints.back().stored);
  const std::vector<HistoryRow> history = from.history();
  const std::vector<double> times = from.stored_times();
  require_together(std::span(history).first(rows), std::span(times).first(steps));
  const std::vector<EpochStart> epochs = from.epochs();
  const auto last_epoch = static_cast<std::size_t>(checkpoints.back().epoch);
  std::size_t step = 0, epoch = 0;
  const auto copy_checkpoints = [&] {
    if (epoch == last_epoch)
      for (const Checkpoint& checkpoint : checkpoints) to.checkpoint(checkpoint);
  };
  for (std::size_t row = 0; row < rows; ++row) {
    to.append(history[row]);
    if (step < steps && times[step] == history[row].t) {
      copy_step(from, step, times[step], fields, to);
      ++step;
    }
    // In the file they come after the start, or after the beginning of their epoch.
    if (row == 0) {
      for (const PhaseError& error : start_errors(from)) to.append_phase_error(error);
      copy_checkpoints();
    }
    if (epoch < last_epoch && epochs[epoch].rows == static_cast<long>(row) + 1) {
      to.begin_epoch(epochs[epoch], from.grid(epoch + 1));
      ++epoch;
      copy_checkpoints();
    }
  }
}

}  // namespace gnomon
