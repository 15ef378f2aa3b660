#include "run/instability.hpp"

#include <fmt/format.h>

#include <cmath>
#include <gnomon/error.hpp>
#include <gnomon/stability.hpp>
#include <optional>

namespace gnomon {

namespace {

std::optional<CriticalStep> critical_step_at(const Model& model, const ButcherTable& table,
                                             const State& state) try {
  constexpr int modes = 1;
  return critical_step(table, leading_modes(ReducedJacobian(model.system(), state), modes));
} catch (const SolutionError&) {
  return std::nullopt;
}

}  // namespace

bool is_conditionally_stable(const Integrator& integrator, const IntegratorSettings& settings) {
  const auto table = integrator.table(settings);
  return table && std::isfinite(stability_boundary(*table, M_PI));
}

void require_stable_step(const Model& model, const Integrator& integrator,
                         const IntegratorSettings& settings, const State& state) {
  constexpr double margin = 1.5;
  if (settings.step == 0) return;  // the error control keeps to it
  const auto critical = critical_step_at(model, *integrator.table(settings), state);
  if (critical && settings.step > margin * critical->step)
    throw SolutionError(fmt::format(
        "steps of {:g} s exceed the critical one of {} at t = {:g} s, {:.3g} s (gnomon stability)",
        settings.step, integrator.name, state.t, critical->step));
}

void require_no_flicker(long flickering_nodes, const Integrator& integrator) {
  if (flickering_nodes > 0)
    throw SolutionError(
        fmt::format("{} contact nodes left contact twice or more: steps exceed the critical one of "
                    "{} (gnomon stability)",
                    flickering_nodes, integrator.name));
}

}  // namespace gnomon
