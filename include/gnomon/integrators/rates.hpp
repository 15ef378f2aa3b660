// The rates of a consistent state.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/system/state.hpp>
#include <gnomon/system/system.hpp>
#include <optional>
#include <utility>

namespace gnomon {

/// Rates of the differential components on a smooth branch (Point::branch): every differential row
/// is ydot + f(t, y) = 0, so they are minus the row at ydot = 0. Fills ydot, zero elsewhere.
/// At a time where a rate jumps, `within` says from which side it is meant (Point::within); absent:
/// from later times.
inline void set_rates(const System& system, const ActiveSet* branch, State& state,
                      std::optional<double> within = {}) {
  std::vector<double> F(state.y.size());
  state.ydot.assign(state.y.size(), 0.0);
  system.residual({.t = state.t,
                   .y = state.y,
                   .ydot = state.ydot,
                   .branch = branch,
                   .within = within,
                   .rates_only = true},
                  F);
  const std::vector<char>& differential = system.structure().differential;
  for (std::size_t i = 0; i < F.size(); ++i)
    if (differential[i]) state.ydot[i] = -F[i];
}

/// Norm of the difference of the rates of two y at the time of `at`, weighted as there [1/time].
inline double distance_of_rates(const System& system, const ErrorNorm& norm,
                                const ActiveSet* branch, const State& at, std::span<const double> a,
                                std::span<const double> b, std::optional<double> within = {}) {
  State first{at.t, {a.begin(), a.end()}, {}}, second{at.t, {b.begin(), b.end()}, {}};
  set_rates(system, branch, first, within);
  set_rates(system, branch, second, within);
  return norm.distance(first.ydot, second.ydot, at.y);
}

/// Gives the state the rates after a jump at its time or at an event, and returns true. Where they
/// do not jump, those of the step that ended there stay to the last digit.
inline bool set_rates_behind_jump(const System& system, const ActiveSet* branch, State& state) {
  // Part of the largest rate: a state that was found as an event is off by 1e-7 of a step.
  constexpr double solved = 1e-6;
  State behind = state;
  set_rates(system, branch, behind);
  double jump = 0, largest = 0;
  for (std::size_t i = 0; i < state.ydot.size(); ++i) {
    jump = std::max(jump, std::abs(behind.ydot[i] - state.ydot[i]));
    largest = std::max({largest, std::abs(behind.ydot[i]), std::abs(state.ydot[i])});
  }
  if (largest_over_processes(jump) <= solved * largest_over_processes(largest)) return false;
  state.ydot = std::move(behind.ydot);
  return true;
}

}  // namespace gnomon
