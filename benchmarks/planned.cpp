// Whether planned runs keep the accuracy that they are asked for, against a much finer run. Prints
// a row in Markdown for each accuracy.
//
//   gnomon_planned FACTOR WITHIN,WITHIN SCENE.toml [KEY=VALUE ...]
//
// FACTOR: of the reference's elements (a power of two where cells are split), of tolerance 1e-6,
// with four times the phases and the scene's own models.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <gnomon/budget/plan.hpp>
#include <gnomon/run/setup.hpp>
#include <sstream>

#include "budget/trial.hpp"

namespace {

using namespace gnomon;

/// Of a mesh from a file the cells are split, whatever its geometry fixes.
Scene reference_of(const Scene& scene, double factor) {
  std::optional<Scene> finer;
  for (const Key& key : scene.controlling_keys())
    if (key.controls->source == ErrorSource::mesh)
      if (auto scaled = key.controls->scaled(scene, factor)) finer = std::move(scaled);
  Scene reference = finer.value_or(scene).with("integrator.rtol", 1e-6);
  for (const Key& key : scene.controlling_keys())
    if (key.controls->source == ErrorSource::phases)
      reference = key.controls->scaled(reference, 0.25).value_or(reference);
  return reference;
}

/// As `gnomon run` does it.
budget::Trial planned_run(const Scene& asked, const Plan& plan, int& runs) {
  budget::Trial trial = budget::try_scene(plan.scene, [](double) { return false; });
  const Budget shown = find_budget(plan, trial.scene, trial.goals, {});
  runs = 1;
  if (const auto finer = refined(plan, asked, shown)) {
    trial = budget::try_scene(*finer, [](double) { return false; });
    runs = 2;
  }
  return trial;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr,
               "expected: gnomon_planned FACTOR WITHIN,WITHIN SCENE.toml [KEY=VALUE ...]\n");
    return 2;
  }
  const std::vector<std::string> overrides(argv + 4, argv + argc);
  const BudgetHooks hooks;
  const Scene scene = checked_scene(argv[3], overrides);
  const budget::Trial reference =
      budget::try_scene(reference_of(scene, std::atof(argv[1])), [](double) { return false; });
  std::istringstream list(argv[2]);
  for (std::string word; std::getline(list, word, ',');) {
    const Scene asked = scene.with("accuracy.within", std::atof(word.c_str()));
    const double begin = cpu_seconds();
    const Plan plan = plan_of(asked, hooks);
    int runs = 0;
    const budget::Trial trial = planned_run(asked, plan, runs);
    const double seconds = cpu_seconds() - begin;
    Budget truth{.values = trial.goals.values,
                 .parts = {{.source = ErrorSource::mesh,
                            .key = "",
                            .how = "",
                            .errors = differences(trial.goals, reference.goals)}}};
    for (double& error : truth.parts[0].errors) error = std::abs(error);
    const double error = wanted_error(asked, truth), within = asked.real("accuracy.within");
    fmt::print("| {} | {:g} % | {:.2g} % | {} | {} | {:.2g} s | {:.2g} s | {} |\n",
               scene.path().stem().string(), 100 * within, 100 * error,
               error <= within ? "yes" : "NO", runs, seconds, trial.cpu_seconds,
               plan.chosen().settings);
    std::fflush(stdout);
  }
}
