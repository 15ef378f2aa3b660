#include "app/run_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/budget.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/summary.hpp>

#include "app/interrupt.hpp"
#include "app/program.hpp"
#include "app/progress.hpp"
#include "app/text_table.hpp"
#include "budget/trial.hpp"
#include "linear/blas.hpp"

namespace gnomon::app {

namespace {

void print_summary(const RunOutcome& outcome, const std::string& result, bool has_mesh, bool kept) {
  const Counters& counters = outcome.counters;
  fmt::print(
      "{} at t = {:g} s after {:.3g} s: {} steps ({} attempts rejected), {} Newton iterations, "
      "{} factorizations\n",
      outcome.text(), outcome.last->t, outcome.wall_seconds, counters.steps,
      counters.rejected_steps, counters.newton_iterations, counters.factorizations);
  TextTable table("lrl");
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
  fmt::print("{}", model_text(outcome.examination));
  if (const std::string ledger = ledger_text(outcome.last->scalars); !ledger.empty())
    fmt::print("{}\n", ledger);
  if (const std::string text = phase_error_text(outcome.phase_errors); !text.empty())
    fmt::print("{}\n", text);
  if (!outcome.budget.empty())
    fmt::print("error budget (docs/accuracy.md; gnomon budget SCENE is more sure):\n{}",
               budget_table(budget_of_json(outcome.budget)));
  if (kept)
    fmt::print("the earlier {} is kept, because it goes further\n", result);
  else
    fmt::print("result: {}{}\n", result,
               has_mesh ? fmt::format(" (for ParaView: {})", sidecar_of(result).string()) : "");
}

/// `reason` of the end, and where the result is.
std::string end_message(const std::string& reason, const RunOutcome& outcome,
                        const std::string& file, bool kept) {
  if (kept) return fmt::format("{} (the earlier {} is kept)", reason, file);
  if (!outcome.last) return fmt::format("{} ({} is not written)", reason, file);
  return fmt::format("{} (everything up to t = {:g} s is in {})", reason, outcome.last->t, file);
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
                     bool quiet, const Resumption* from, const Plan* plan) {
  Progress progress(quiet, settings.end);
  long iterations = 0;
  const double begin = cpu_seconds();
  const auto judge = [&](const Model& model, const State& state, const Observation& observed) {
    if (!setup.scene.flag("output.budget") && !plan) return EndJudgement();
    const std::optional<Goals> goals = goals_of(model, state, observed);
    if (!goals) return EndJudgement();
    progress.say("estimating the errors");
    BudgetHooks hooks{.interrupted = InterruptGuard::interrupted};
    // Twice and more what its companions take by their work, where factors do not fill in.
    constexpr double always = 5, part_of_run = 0.5;
    if (!plan) hooks.seconds = std::max(always, part_of_run * (cpu_seconds() - begin));
    const double work = static_cast<double>(iterations) * goals->nonzeros;
    const Budget budget = plan ? find_budget(*plan, setup.scene, *goals, hooks)
                               : quick_budget(setup.scene, *goals, work, hooks);
    return EndJudgement{budget_json(budget), budget_warnings(budget)};
  };
  const RunHooks hooks{.on_step =
                           [&](const HistoryRow& row) {
                             iterations = row.counters.newton_iterations;
                             progress.show(row);
                           },
                       .on_warning = [&](const std::string& text) { progress.warn(text); },
                       .judge = judge,
                       .interrupted = InterruptGuard::interrupted};
  StorePolicy policy = store_policy(setup.scene);
  if (plan) policy.phase_tolerance = plan->chosen().within;
  return run(*setup.model, chosen_integrator(setup.scene), settings, policy, &writer, hooks, from);
}

int report_end(const RunOutcome& outcome, const RunOptions& options, bool has_mesh, bool kept) {
  const std::string result = options.result.string();
  if (outcome.status == RunOutcome::Status::failed)
    throw SolutionError(end_message(outcome.diagnosis, outcome, result, kept));
  if (!outcome.last) throw Error(end_message("interrupted in the start", outcome, result, kept));
  if (!options.quiet && options.summary != "-") print_summary(outcome, result, has_mesh, kept);
  return outcome.status == RunOutcome::Status::finished ? success : other_failure;
}

}  // namespace gnomon::app
