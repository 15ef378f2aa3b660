// How good the error budget is: of scenes, the estimated error beside the true one, against a much
// finer run. Prints a table in Markdown.
//
//   gnomon_effectivity FACTOR SCENE.toml [KEY=VALUE ...]
//
// FACTOR: of the reference's elements, which also has a hundredth of the tolerance, or a tenth of
// the step, half the fraction of solves, twice the phases and the models that neglect less.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gnomon/run/setup.hpp>

#include "budget/trial.hpp"

namespace {

using namespace gnomon;

/// With the mesh by the key that the budget has used.
Scene reference_of(Scene scene, double factor, const Budget& budget) {
  const auto used = std::ranges::find(budget.parts, ErrorSource::mesh, &BudgetPart::source);
  for (const Key& key : scene.controlling_keys()) {
    const bool is_mesh = key.controls->source == ErrorSource::mesh;
    if (is_mesh && (used == budget.parts.end() || key.name != used->key)) continue;
    const double finer = is_mesh                                     ? factor
                         : key.controls->source != ErrorSource::time ? 0.5
                         : scene.given("integrator.step")            ? 0.1
                                                                     : 0.01;
    if (auto changed = key.controls->scaled(scene, finer)) scene = std::move(*changed);
  }
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "expected: gnomon_effectivity FACTOR SCENE.toml [KEY=VALUE ...]\n");
    return 2;
  }
  const std::filesystem::path file = argv[2];
  const Scene scene = checked_scene(file, {argv + 3, argv + argc});
  const BudgetHooks hooks;
  const Budget budget = find_budget(scene, hooks);
  const budget::Trial run = budget::try_scene(scene, [](double) { return false; });
  const budget::Trial reference = budget::try_scene(
      reference_of(run.scene, std::atof(argv[1]), budget), [](double) { return false; });
  const Budget quick = quick_budget(run.scene, run.goals, run.work, hooks);
  const std::vector<double> errors =
      differences(with_nodal_pressures(run.goals), with_nodal_pressures(reference.goals));
  fmt::print("| {} | {:.2g} s | {:.2g} s | {:.2g} s |", file.stem().string(), budget.run_seconds,
             budget.companion_seconds, quick.companion_seconds);
  for (std::size_t i = 0; i < errors.size(); ++i)
    fmt::print(" {} {:.2g} {:.2g} / {:.2g} % = {:.2g} {:.2g} |", budget.values[i].name,
               100 * budget.total(i), 100 * quick.total(i), 100 * std::abs(errors[i]),
               budget.total(i) / std::abs(errors[i]), quick.total(i) / std::abs(errors[i]));
  fmt::print("\n");
}
