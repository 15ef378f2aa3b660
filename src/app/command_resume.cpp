// gnomon resume: continues from the last checkpoint of a result, or from the start if it has none,
// in a new file that replaces the old one as soon as it has gone further, or has ended at the same
// time.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/same_time.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/run_end.hpp"
#include "run/store_schedule.hpp"
#include "scene/key_check.hpp"

namespace gnomon::app {

namespace {

/// Throws InputError where the scene differs from that of the result in a key on which the problem,
/// its mesh, the method or the memory of the method may depend.
void require_changeable(const Scene& old, const Scene& scene) {
  const std::vector<Key> table = key_table(scene.text("problem"));
  for (const std::string& name : Scene::differing_keys(old, scene)) {
    if (const auto key = find_key(table, name); key && key->on_resume) continue;
    std::vector<std::string> names;
    for (const Key& key : table)
      if (key.on_resume) names.push_back(key.name);
    throw InputError(
        fmt::format("--set {}: resuming can change only {}", name, fmt::join(names, ", ")));
  }
}

Scene changed_scene(const ResultReader& earlier, const RunOptions& options) {
  const Scene old = scene_of_result(earlier, options.result);
  std::vector<std::string> overrides = options.overrides;
  if (options.end) overrides.push_back(fmt::format("time.end={}", *options.end));
  Scene scene = scene_of_result(earlier, options.result, overrides);
  require_changeable(old, scene);
  check_run(scene);
  return scene;
}

/// None if the result holds no complete checkpoint: it ended at its start, was killed before the
/// first one, or they are damaged.
std::optional<Resumption> last_checkpoint(const ResultReader& earlier, const std::string& name) {
  const std::vector<Checkpoint> checkpoints = earlier.checkpoints();
  if (checkpoints.empty()) return std::nullopt;
  Resumption from;
  from.checkpoint = checkpoints.back();
  const auto rows = static_cast<std::size_t>(from.checkpoint.rows);
  const auto stored = static_cast<std::size_t>(from.checkpoint.stored);
  const std::vector<HistoryRow> history = earlier.history();
  const std::vector<double> times = earlier.stored_times();
  if (rows > history.size() || stored > times.size())
    throw InputError(
        fmt::format("{}: its checkpoint belongs to a longer history than the file holds", name));
  from.row = history[rows - 1];
  if (stored > 0) from.stored = times[stored - 1];
  from.wall_seconds = earlier.wall_seconds();
  from.phase_errors = start_errors(earlier);
  from.epochs = earlier.epochs();
  from.epochs.resize(static_cast<std::size_t>(from.checkpoint.epoch));
  return from;
}

void check_end(const Scene& scene, double reached, const std::string& name) {
  const double end = scene.real("time.end");
  if (end < reached)
    throw InputError(fmt::format("{}: expected at least {} s, which {} has reached, got {}",
                                 scene.where("time.end"), reached, name, end));
}

/// An output time that has already passed would be missing in the result without a message.
void check_times(const Scene& scene, const ResultReader& earlier, double reached) {
  const std::vector<double> stored = earlier.stored_times();
  for (const double t : scene.reals("output.times"))
    if (t <= reached && std::ranges::none_of(stored, [t](double s) { return same_time(s, t); }))
      throw InputError(fmt::format("{}: expected times after {} s, where the run continues, got {}",
                                   scene.where("output.times"), reached, t));
}

bool is_same(const Model& model, const ResultReader& earlier) {
  const auto same_block = [](const BlockSize& a, const BlockSize& b) {
    return a.name == b.name && a.size == b.size;
  };
  const auto grid = model.grid, old = earlier.grid();
  const bool same_grid = grid.has_value() == old.has_value() &&
                         (!grid || (grid->points == old->points && grid->cells == old->cells));
  return std::ranges::equal(model.blocks, earlier.header().blocks, same_block) && same_grid;
}

/// The time that the result has reached; a result without a step has reached none.
double time_reached(const ResultReader& earlier) {
  const std::vector<HistoryRow> history = earlier.history();
  return history.empty() ? 0.0 : history.back().t;
}

/// time.until, where it holds already, so that the run would not continue.
std::optional<Until> held_until(const Scene& scene, const std::optional<Resumption>& from) {
  const std::optional<Until> until = store_policy(scene).until;
  return from && until && excess(*until, from->row.scalars) >= 0 ? until : std::nullopt;
}

bool asks_for_more(const RunOptions& options) {
  return options.end || !options.summary.empty() || !options.overrides.empty();
}

/// Whether there is nothing to continue. Throws InputError where more than that is asked for.
bool is_finished(const ResultReader& earlier, const Scene& scene, const RunOptions& options,
                 const std::optional<Resumption>& from) {
  const std::string name = options.result.string();
  if (const std::optional<Until> until = held_until(scene, from)) {
    if (asks_for_more(options))
      throw InputError(
          fmt::format("{}: expected a condition that does not hold yet at t = {:.6g} s, which {} "
                      "has reached, or none (--set 'time.until=\"\"'), got \"{}\"",
                      until->where, from->row.t, name, until->text));
    if (!options.quiet)
      fmt::print("{} is finished: {}; --set 'time.until=\"\"' continues to time.end\n", name,
                 until->text);
    return true;
  }
  if (earlier.status() != "finished" || scene.real("time.end") != time_reached(earlier))
    return false;
  if (!options.summary.empty() || !options.overrides.empty())
    throw InputError(
        fmt::format("--set, --summary: expected a run to continue, {} is finished (--end continues "
                    "to a later time)",
                    name));
  if (!options.quiet) fmt::print("{} is finished; --end continues to a later time\n", name);
  return true;
}

/// With the model of the new end, or, where more of the boundary would come into reach until then,
/// with that of the result, which it joins when it comes near.
Setup set_up_as_before(const Scene& scene, const ResultReader& earlier,
                       const std::filesystem::path& file) {
  Setup setup = set_up_again(scene, earlier.grid());
  if (is_same(*setup.model, earlier)) return setup;
  const double end = earlier.header().model_end;
  setup = set_up_again(scene, earlier.grid(),
                       end > 0 ? end : scene_of_result(earlier, file).real("time.end"));
  if (!is_same(*setup.model, earlier))
    throw InputError(fmt::format("{}: this version of gnomon makes a different mesh from its scene",
                                 file.string()));
  return setup;
}

std::vector<std::string> field_names(const Model& first, const Resumption& from) {
  const std::shared_ptr<const Model> later = model_of_epoch(first, from.epochs);
  const Model& model = later ? *later : first;
  std::vector<std::string> names;
  for (const GridField& field : model.fields(state_at(from.checkpoint, model)))
    names.push_back(field.name);
  return names;
}

}  // namespace

int resume_command(const RunOptions& options) {
  const std::string name = options.result.string();
  RunOptions files = options;
  files.force = true;
  const ResultReader earlier(options.result);
  const std::optional<Resumption> from = last_checkpoint(earlier, name);
  const double reached = time_reached(earlier);
  const Scene scene = changed_scene(earlier, options);
  check_end(scene, reached, name);
  if (is_finished(earlier, scene, options, from)) return success;
  if (from) check_times(scene, earlier, from->row.t);
  if (!options.force && options.summary != "-" && std::filesystem::is_regular_file(options.summary))
    throw InputError(
        fmt::format("{} exists; give another name with --summary, or --force to replace it",
                    options.summary.string()));
  check_outputs(files);

  if (!options.quiet) warn_of_slow_blas();
  if (!options.quiet)
    print_remarks({from ? "" : name + " holds no checkpoint: begins at its start",
                   dropped_times_text(scene)});
  const Setup setup = set_up_as_before(scene, earlier, options.result);
  const RunHeader header = run_header(setup);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  const RunOutcome outcome = [&] {
    const InterruptGuard guard(!options.quiet);
    ResultWriter writer(options.result, header, setup.model->grid, Earlier::replaced, reached);
    if (from) copy_to_last_checkpoint(earlier, field_names(*setup.model, *from), writer);
    return integrate(setup, settings, writer, options.quiet, from ? &*from : nullptr);
  }();
  const bool replaced = outcome.last && outcome.last->t >= reached;
  write_summary(files, summary_json(setup.scene, header, settings, outcome, setup.model->remarks),
                replaced);
  return report_end(outcome, options, setup.model->grid.has_value(), !replaced);
}

}  // namespace gnomon::app
