// gnomon budget: how wrong the result of a scene is, and by what. gnomon plan: the settings for an
// accuracy.

#include <fmt/format.h>

#include <gnomon/budget/plan.hpp>
#include <gnomon/run/setup.hpp>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"

namespace gnomon::app {

namespace {

/// Counts runs on a live line while `find` lasts.
template <class Find>
auto with_progress(bool quiet, Find find) {
  const LiveLine line("", quiet);
  const InterruptGuard guard(!quiet);
  int runs = 0;
  return find(BudgetHooks{
      .on_run =
          [&](const std::string& what) { line.show(fmt::format("run {}: {}", ++runs, what)); },
      .interrupted = InterruptGuard::interrupted});
}

}  // namespace

void budget_command(const BudgetOptions& options) {
  const Scene scene = checked_scene(options.scene, options.overrides);
  const Budget budget = with_progress(
      options.quiet, [&](const BudgetHooks& hooks) { return find_budget(scene, hooks); });
  fmt::print("{}", options.json ? budget_json(budget) : budget_text(budget));
}

void plan_command(const BudgetOptions& options) {
  const Scene scene = checked_scene(options.scene, options.overrides);
  fmt::print("{}", plan_text(planned(scene, options.quiet)));
}

Plan planned(const Scene& scene, bool quiet) {
  return with_progress(quiet, [&](const BudgetHooks& hooks) { return plan_of(scene, hooks); });
}

}  // namespace gnomon::app
