#include "budget/trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <gnomon/newton/interruption.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>

namespace gnomon::budget {

namespace {

/// A value in a line for people: with six digits, where scene/toml_text.hpp writes all.
std::string text_of(const SceneValue& value) {
  return std::visit(
      []<class T>(const T& known) {
        if constexpr (std::is_same_v<T, std::string>)
          return fmt::format("\"{}\"", known);
        else if constexpr (std::is_same_v<T, double>)
          return fmt::format("{:g}", known);
        else if constexpr (std::is_same_v<T, std::vector<double>>)
          return known.size() == 1 ? fmt::format("{:g}", known[0])
                                   : fmt::format("[{:g}]", fmt::join(known, ", "));
        else
          return fmt::format("{}", known);
      },
      value);
}

}  // namespace

std::optional<std::string> failure_of(const std::function<void()>& attempt) try {
  attempt();
  return {};
} catch (const Interrupted&) {
  throw;
} catch (const Error& error) {
  return error.what();
}

Trial try_scene(const Scene& scene, const std::function<bool(double)>& interrupted,
                const Goals* unlike, double most_work) try {
  const double begin = cpu_seconds();
  const Setup setup = set_up(scene);
  if (unlike && nodes_of(*setup.model) == unlike->nodes)
    throw MeshUnchanged("elements of another size make the same mesh, its geometry fixes them");
  StorePolicy policy = store_policy(setup.scene);
  policy.checkpoint_seconds = 0;
  policy.phase_errors = policy.examine_end = false;
  const auto nonzeros = static_cast<double>(setup.model->system().structure().pattern.nonzeros());
  const auto work_of = [&](const Counters& counters) {
    return static_cast<double>(counters.newton_iterations) * nonzeros;
  };
  constexpr double no_limit = 1e15;
  double work = 0;
  const std::function<bool()> asked = [&] { return interrupted(work); };
  const Interruptible start(asked);  // each step has a question of its own
  const RunOutcome outcome =
      run(*setup.model, chosen_integrator(setup.scene),
          integrator_settings(setup.scene, *setup.model), policy, nullptr,
          {.on_step = [&](const HistoryRow& row) { work = work_of(row.counters); },
           .interrupted = asked,
           .most_newton_iterations = static_cast<long>(std::min(most_work / nonzeros, no_limit))});
  if (outcome.status == RunOutcome::Status::failed) {
    if (interrupted(work_of(outcome.counters))) throw Interrupted("interrupted");
    throw SolutionError(outcome.diagnosis);
  }
  if (outcome.status == RunOutcome::Status::interrupted) throw Interrupted("interrupted");
  const Model& model = outcome.successor ? *outcome.successor : *setup.model;
  auto goals = goals_of(model, *outcome.state, outcome.last->scalars);
  if (!goals)
    throw InputError(fmt::format(
        "{}: expected a problem with a worn surface, {} has none whose error could be judged",
        scene.path().string(), scene.text("problem")));
  return {.scene = setup.scene,
          .goals = std::move(*goals),
          .cpu_seconds = cpu_seconds() - begin,
          .work = work};
} catch (const Interruption& interruption) {
  throw Interrupted(interruption.what());
}

long touching_nodes(const Goals& goals) {
  return std::ranges::count_if(goals.surface.pressure, [](double p) { return p > 0; });
}

Scene ending_at(const Scene& scene, double time) {
  return scene.has("time.until") ? scene.with("time.end", time).without("time.until") : scene;
}

}  // namespace gnomon::budget

namespace gnomon {

std::string change_text(const Scene& from, const Scene& to) {
  std::string text;
  for (const std::string& key : Scene::differing_keys(from, to))
    if (to.has(key))
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, budget::text_of(to.any(key)));
  return text;
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace gnomon
