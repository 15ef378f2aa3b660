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

}  // namespace

std::vector<PhaseError> start_errors(const ResultReader& from) {
  std::vector<PhaseError> errors = from.phase_errors();
  std::erase_if(errors, [](const PhaseError& error) { return error.t > 0; });
  return errors;
}

namespace {

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

void copy_to_last_checkpoint(const ResultReader& from, const std::vector<std::string>& fields,
                             ResultWriter& to) {
  const std::vector<Checkpoint> checkpoints = from.checkpoints();
  const auto rows = static_cast<std::size_t>(checkpoints.back().rows);
  const auto steps = static_cast<std::size_t>(checkpoints.back().stored);
  const std::vector<HistoryRow> history = from.history();
  const std::vector<double> times = from.stored_times();
  require_together(std::span(history).first(rows), std::span(times).first(steps));
  std::size_t step = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    to.append(history[row]);
    if (step < steps && times[step] == history[row].t) {
      copy_step(from, step, times[step], fields, to);
      ++step;
    }
    // In the file they come after the start.
    if (row > 0) continue;
    for (const PhaseError& error : start_errors(from)) to.append_phase_error(error);
    for (const Checkpoint& checkpoint : checkpoints) to.checkpoint(checkpoint);
  }
}

}  // namespace gnomon
