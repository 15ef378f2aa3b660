#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <optional>

#include "app/commands.hpp"
#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

namespace {

/// The part of `gnomon resume` before the integration.
void read_for_resuming(const std::filesystem::path& file) {
  const ResultReader result(file);
  const std::vector<HistoryRow> history = result.history();
  const std::vector<double> stored = result.stored_times();
  const Scene scene = parse_scene(result.header().scene, file.string(), {}, key_table);
  check_run(scene);
  const std::vector<Checkpoint> checkpoints = result.checkpoints();
  for (const Checkpoint& checkpoint : checkpoints) {
    demand(checkpoint.rows >= 1 && checkpoint.rows <= std::ssize(history),
           "the history holds the row of a checkpoint");
    demand(checkpoint.stored >= 0 && checkpoint.stored <= std::ssize(stored),
           "the steps stored by a checkpoint are there");
  }
  if (checkpoints.empty() || !is_small(scene)) return;
  state_at(checkpoints.back(), *set_up(scene).model);
}

void read_all_steps(const std::filesystem::path& file) {
  const ResultReader result(file);
  const std::vector<std::string> names = result.field_names();
  const std::vector<double> times = result.stored_times();
  for (std::size_t step = 0; step < times.size(); ++step)
    for (const std::string& name : names) result.field(step, name);
  for (const double time : times) result.contact(time);
}

}  // namespace

void read_result(const std::filesystem::path& file) {
  const std::function<void()> readings[] = {
      [&] { app::info_command(file); }, [&] { app::contact_command(file, {}); },
      [&] {
        app::compare_command({file, file}, {});
      },
      [&] { read_all_steps(file); }, [&] { read_for_resuming(file); }};
  is_result(file);
  std::optional<InputError> refusal;
  for (const auto& reading : readings) {  // one may refuse what another can read
    try {
      reading();
    } catch (const InputError& error) {
      refusal = error;
    }
  }
  if (refusal) throw *refusal;
}

void result(std::string_view bytes) {
  static const Folder folder("result");
  read_result(folder.put("r", bytes));
}

}  // namespace gnomon::fuzz
