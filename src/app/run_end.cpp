#include "app/run_end.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/summary.hpp>

#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/progress.hpp"
#include "app/text_table.hpp"
#include "linear/blas.hpp"

namespace gnomon::app {

namespace {

void print_summary(const RunOutcome& outcome, const EndReport& report) {
  const Counters& counters = outcome.counters;
  fmt::print(
      "{} at t = {:g} s after {:.3g} s: {} steps ({} attempts rejected), {} Newton iterations, "
      "{} factorizations\n",
      outcome.text(), outcome.last->t, outcome.wall_seconds, counters.steps,
      counters.rejected_steps, counters.newton_iterations, counters.factorizations);
  TextTable table({{}, {.align = TextTable::Align::right}, {}});
  // These are in the balance, if there is one.
  const auto is_of_balance = [&](const std::string& name) {
    return !outcome.examination.forces.empty() &&
           (name.starts_with("force_") || name.starts_with("torque_"));
  };
  for (const Scalar& scalar : outcome.last->scalars)
    if (!is_of_balance(scalar.name))
      table.add({"  " + scalar.name, fmt::format("{:.8g}", scalar.value), scalar.unit});
  fmt::print("{}", table.text());
  if (const std::string forces =
          balance_text(outcome.examination, dimension_of(outcome.last->scalars));
      !forces.empty())
    fmt::print("{}", forces);
  if (const std::string ledger = ledger_text(outcome.last->scalars); !ledger.empty())
    fmt::print("{}\n", ledger);
  if (const std::string text = phase_error_text(outcome.phase_errors); !text.empty())
    fmt::print("{}\n", text);
  if (report.kept)
    fmt::print("the earlier {} is kept, because it goes further\n", report.result.string());
  else
    fmt::print("result: {}{}\n", report.result.string(),
               report.has_mesh
                   ? fmt::format(" (for ParaView: {})", sidecar_of(report.result).string())
                   : "");
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

std::string failure_message(const RunOutcome& outcome, const EndReport& report) {
  const std::string file = report.result.string();
  if (report.kept) return fmt::format("{} (the earlier {} is kept)", outcome.diagnosis, file);
  if (!outcome.last) return fmt::format("{} ({} is not written)", outcome.diagnosis, file);
  return fmt::format("{} (everything up to t = {:g} s is in {})", outcome.diagnosis,
                     outcome.last->t, file);
}

}  // namespace

void warn_of_slow_blas() {
  if (is_reference_blas())
    fmt::print(
        stderr,
        "gnomon: warning: {} is the reference BLAS: factorizations take 4 to 6 times as long "
        "as with OpenBLAS (Debian: libopenblas0-pthread)\n",
        blas_name());
}

void print_remarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks)
    if (!remark.empty()) fmt::print(stderr, "{}\n", remark);
}

RunOutcome integrate(const Setup& setup, const IntegratorSettings& settings, ResultWriter& writer,
                     bool quiet, const Resumption* from) {
  Progress progress(Progress::mode_for_stderr(quiet), settings.end);
  const RunHooks hooks{.on_step = [&](const HistoryRow& row) { progress.show(row); },
                       .on_warning = [&](const std::string& text) { progress.warn(text); },
                       .interrupted = InterruptGuard::interrupted};
  try {
    RunOutcome outcome = run(*setup.model, chosen_integrator(setup.scene), settings,
                             store_policy(setup.scene), &writer, hooks, from);
    progress.finish();
    return outcome;
  } catch (const std::exception&) {
    progress.finish();  // before the message about it
    throw;
  }
}

int report_end(const RunOutcome& outcome, const EndReport& report) {
  if (outcome.status == RunOutcome::Status::failed)
    throw SolutionError(failure_message(outcome, report));
  if (!report.quiet && report.table) print_summary(outcome, report);
  return exit_code(outcome);
}

}  // namespace gnomon::app
