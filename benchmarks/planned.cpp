// Whether planned runs keep the accuracy that they are asked for, against a much finer run. Prints
// a row in Markdown for each accuracy.
//
//   gnomon_planned FACTOR WITHIN,WITHIN SCENE.toml [KEY=VALUE ...]
//
// FACTOR: of the reference's elements (a power of two where cells are split), of tolerance 1e-6,
// with four times the phases, at least 64, and the scene's own models.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gnomon/budget/plan.hpp>
#include <gnomon/run/setup.hpp>
#include <sstream>

#include "budget/trial.hpp"

namespace {

using namespace gnomon;

/// On a finer mesh than the run's, by the key that its budget has used, with the models of `asked`.
Scene reference_of(const Scene& asked, const Scene& run, const Budget& shown, double factor) {
  const auto mesh = std::ranges::find(shown.parts, ErrorSource::mesh, &BudgetPart::source);
  Scene reference = run.with("integrator.rtol", 1e-6);
  if (reference.knows("solver.reduce")) reference = reference.without("solver.reduce");
  for (const Key& key : asked.controlling_keys()) {
    const auto scale = [&](double by) {
      reference = key.controls->scaled(reference, by).value_or(reference);
    };
    if (key.controls->source == ErrorSource::model)
      reference = reference.with(key.name, asked.any(key.name));
    if (key.controls->source == ErrorSource::phases && reference.given(key.name))
      scale(std::min(0.25, reference.reals(key.name).at(0) / 64));
    if (mesh != shown.parts.end() && key.name == mesh->key) scale(factor);
  }
  return reference;
}

struct PlannedRun {
  budget::Trial trial;
  Budget shown;
  int runs = 1;
};

/// As `gnomon run` does it.
PlannedRun run_planned(const Scene& asked, const Plan& plan) {
  const auto goes_on = [](double) { return false; };
  const auto judged = [&](const Scene& scene, int runs) {
    PlannedRun run{.trial = budget::try_scene(scene, goes_on), .shown = {}, .runs = runs};
    run.shown = find_budget(plan, run.trial.scene, run.trial.goals, {});
    return run;
  };
  PlannedRun run = judged(plan.scene, 1);
  Scene settings = plan.scene;
  while (const auto finer = refined(plan, asked, settings, run.shown, run.runs)) {
    settings = *finer;
    run = judged(settings, run.runs + 1);
  }
  return run;
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
  std::istringstream list(argv[2]);
  for (std::string word; std::getline(list, word, ',');) {
    const Scene asked = scene.with("accuracy.within", std::atof(word.c_str()));
    const double begin = cpu_seconds();
    const Plan plan = plan_of(asked, hooks);
    const auto [trial, shown, runs] = run_planned(asked, plan);
    const double seconds = cpu_seconds() - begin;
    const budget::Trial reference = budget::try_scene(
        reference_of(asked, trial.scene, shown, std::atof(argv[1])), [](double) { return false; });
    Budget truth{.values = trial.goals.values,
                 .parts = {{.source = ErrorSource::mesh,
                            .key = "",
                            .how = "",
                            .errors = differences(with_nodal_pressures(trial.goals),
                                                  with_nodal_pressures(reference.goals))}}};
    for (double& error : truth.parts[0].errors) error = std::abs(error);
    const double error = wanted_error(asked, truth), within = asked.real("accuracy.within");
    fmt::print("| {} | {:g} % | {:.2g} % | {} | {} | {:.2g} s | {:.2g} s | {} |\n",
               scene.path().stem().string(), 100 * within, 100 * error,
               error <= within ? "yes" : "NO", runs, seconds, trial.cpu_seconds,
               plan.chosen().settings);
    std::fflush(stdout);
  }
}
