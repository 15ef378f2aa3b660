// gnomon run: integrates a scene, writes its result and summary, and tells how it went.

#include <fmt/format.h>

#include <gnomon/error.hpp>
#include <gnomon/result_files.hpp>
#include <gnomon/run.hpp>
#include <gnomon/stability.hpp>
#include <gnomon/summary.hpp>
#include <utility>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/output_files.hpp"
#include "app/program.hpp"
#include "app/progress.hpp"
#include "app/setup.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

void print_summary(const RunOutcome& outcome, const RunOptions& options) {
  const Counters& counters = outcome.counters;
  fmt::print(
      "{} at t = {:g} s after {:.3g} s: {} steps ({} attempts rejected), {} Newton iterations, "
      "{} factorizations\n",
      outcome.status == RunOutcome::Status::finished ? "finished" : "interrupted", outcome.last->t,
      outcome.wall_seconds, counters.steps, counters.rejected_steps, counters.newton_iterations,
      counters.factorizations);
  TextTable table({{}, {.align = TextTable::Align::right}, {}});
  for (const Scalar& scalar : outcome.last->scalars)
    table.add({"  " + scalar.name, fmt::format("{:.8g}", scalar.value), scalar.unit});
  fmt::print("{}result: {} (for ParaView: {})\n", table.text(), options.result.string(),
             sidecar_of(options.result).string());
}

/// An explicit method above its critical step finishes like any other; its numbers are worthless.
void warn_of_flicker(const RunOutcome& outcome, const Integrator& integrator) {
  const auto table = integrator.table({});
  if (outcome.flickering_nodes == 0 || !table || !is_explicit(*table)) return;
  fmt::print(stderr,
             "gnomon: warning: {} contact nodes left contact twice or more: steps seem to exceed "
             "the critical one of {} (gnomon stability)\n",
             outcome.flickering_nodes, integrator.name);
}

void warn_of_mesh(const RunOutcome& outcome) {
  if (!outcome.warning.empty()) fmt::print(stderr, "gnomon: warning: {}\n", outcome.warning);
}

int exit_code(const RunOutcome& outcome) {
  switch (outcome.status) {
    case RunOutcome::Status::finished:
      return success;
    case RunOutcome::Status::interrupted:
      return other_failure;
    case RunOutcome::Status::failed:
      return solution_failed;
  }
  return other_failure;
}

std::string failure_message(const RunOutcome& outcome, const RunOptions& options, bool earlier) {
  if (!outcome.last && earlier)
    return fmt::format("{} (the earlier {} is kept)", outcome.diagnosis, options.result.string());
  if (!outcome.last) return outcome.diagnosis;
  return fmt::format("{} (everything up to t = {:g} s is in {})", outcome.diagnosis,
                     outcome.last->t, options.result.string());
}

RunOutcome integrate(const Setup& setup, const RunHeader& header,
                     const IntegratorSettings& settings, const RunOptions& options) {
  const InterruptGuard guard(!options.quiet);  // first: a result that exists is always closed
  ResultWriter writer(options.result, header, setup.model->grid(),
                      options.force ? Earlier::replaced : Earlier::refused);
  Progress progress(Progress::mode_for_stderr(options.quiet), settings.end);
  const RunHooks hooks{.on_step = [&](const HistoryRow& row) { progress.show(row); },
                       .interrupted = InterruptGuard::interrupted};
  try {
    RunOutcome outcome = run(*setup.model, chosen_integrator(setup.scene), settings,
                             store_policy(setup.scene), &writer, hooks);
    progress.finish();
    return outcome;
  } catch (const std::exception&) {
    progress.finish();  // before the message about it
    throw;
  }
}

}  // namespace

int run_command(const RunOptions& given) {
  RunOptions options = given;
  Scene scene = checked_scene(options.scene, options.overrides);
  if (options.result.empty())
    options.result = default_result(options.scene, scene.text("integrator.name"));
  check_outputs(options);  // before anything that takes time
  const bool earlier = is_taken(options.result);

  const Setup setup = set_up(std::move(scene));
  const RunHeader header = run_header(setup);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  const RunOutcome outcome = integrate(setup, header, settings, options);
  write_summary(options, summary_json(setup.scene, header, settings, outcome),
                outcome.last.has_value());
  if (outcome.status == RunOutcome::Status::failed)
    throw SolutionError(failure_message(outcome, options, earlier));
  if (!options.quiet && options.summary != "-") print_summary(outcome, options);
  if (!options.quiet) warn_of_mesh(outcome);
  if (!options.quiet) warn_of_flicker(outcome, chosen_integrator(setup.scene));
  return exit_code(outcome);
}

}  // namespace gnomon::app
