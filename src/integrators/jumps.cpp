#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <set>

namespace gnomon {

namespace {

/// A switching function that has changed its sign, after a part of the step.
struct Crossing {
  std::size_t function;
  double after;
};

/// F on one branch less F on the one before is the jump of the rates, where both have a value. The
/// jumps of a node are taken one after the other: behind a layer that a step has passed as a whole
/// the rate may be what it was before. Their sum without signs. `branch` is the one at the start.
std::vector<double> jumps_of_rates(const System& system, const State& from, const State& to,
                                   std::vector<Crossing> crossings, ActiveSet branch) {
  const Structure& structure = system.structure();
  std::ranges::stable_sort(crossings, {}, &Crossing::after);
  std::vector<double> sum(to.y.size()), before(to.y.size()), behind(to.y.size());
  try {
    system.residual({to.t, to.y, to.ydot, &branch, from.t}, before);
    while (!on_all_processes(crossings.empty())) {
      std::set<int> nodes;  // one crossing of each
      std::erase_if(crossings, [&](const Crossing& crossing) {
        const bool next = nodes.insert(structure.switch_node[crossing.function]).second;
        if (next) branch[crossing.function] = !branch[crossing.function];
        return next;
      });
      system.residual({to.t, to.y, to.ydot, &branch, from.t}, behind);
      for (std::size_t i = 0; i < sum.size(); ++i)
        if (structure.differential[i]) sum[i] += std::abs(behind[i] - before[i]);
      std::swap(before, behind);
    }
  } catch (const RecoverableError&) {
    return std::vector<double>(to.y.size());
  }
  return sum;
}

/// F on the other branch less F on the own one.
std::vector<double> difference(const System& system, const State& at, double within,
                               const ActiveSet& own, const ActiveSet& other) {
  std::vector<double> here(at.y.size()), there(at.y.size());
  system.residual({at.t, at.y, at.ydot, &own, within}, here);
  system.residual({at.t, at.y, at.ydot, &other, within}, there);
  for (std::size_t i = 0; i < here.size(); ++i) there[i] -= here[i];
  return there;
}

std::vector<double> switching_values(const System& system, const State& at) {
  std::vector<double> values(system.structure().switch_jumps.size());
  system.switching({.t = at.t, .y = at.y, .ydot = at.ydot}, values);
  return values;
}

/// Whether the algebraic rows jump in time at a state.
bool loads_jump(const System& system, const State& state) {
  constexpr double rounding = 1e-9;
  const Structure& structure = system.structure();
  std::vector<double> before(state.y.size()), behind(state.y.size());
  const double earlier = std::nextafter(state.t, state.t - 1);
  system.residual({state.t, state.y, state.ydot, state.own_branch(), earlier}, before);
  system.residual({state.t, state.y, state.ydot, state.own_branch()}, behind);
  bool jumps = false;
  for (std::size_t i = 0; i < before.size(); ++i)
    jumps |= !structure.differential[i] &&
             std::abs(behind[i] - before[i]) > rounding * structure.row_scale[i];
  return !on_all_processes(!jumps);
}

}  // namespace

CrossedJumps jumps_between(const System& system, const State& from, const State& to, bool size) {
  CrossedJumps found;
  const std::vector<char>& may_jump = system.structure().switch_jumps;
  if (std::ranges::count(may_jump, 1) == 0) return found;
  std::vector<double> before = switching_values(system, from);
  const std::vector<double> after = switching_values(system, to);
  ActiveSet at_start;
  std::vector<Crossing> crossings;
  for (std::size_t j = 0; j < may_jump.size(); ++j) {
    const bool active = after[j] <= 0;
    at_start.push_back(may_jump[j] ? before[j] <= 0 : active);
    if (at_start.back() == active) continue;
    found.functions.push_back(j);
    crossings.push_back({j, before[j] / (before[j] - after[j])});
    found.first = std::min(found.first, crossings.back().after);
  }
  if (size && !on_all_processes(found.functions.empty()))
    found.by = jumps_of_rates(system, from, to, std::move(crossings), std::move(at_start));
  found.before = std::move(before);
  return found;
}

double common_jump(const System& system, const State& from, const State& to, std::size_t function) {
  ActiveSet own;
  for (const double value : switching_values(system, to)) own.push_back(value <= 0);
  ActiveSet other = own;
  other[function] = !own[function];
  const std::vector<double> at_start = difference(system, from, from.t, own, other),
                            at_end = difference(system, to, from.t, own, other);
  double largest = 0;
  for (std::size_t i = 0; i < at_start.size(); ++i)
    if (system.structure().differential[i] && at_start[i] * at_end[i] > 0)
      largest = std::max(largest, std::min(std::abs(at_start[i]), std::abs(at_end[i])));
  return largest;
}

JumpError error_of_jumps(const System& system, const ErrorNorm& norm, const State& from,
                         const State& to, double h) {
  constexpr double wrong = 0.5;  // part of the step
  constexpr double safety = 0.9;
  const CrossedJumps jumps = jumps_between(system, from, to, true);
  if (jumps.by.empty()) return {};
  std::vector<double> error;
  for (const int i : norm.components()) error.push_back(wrong * h * jumps.by[i]);
  JumpError estimate{.error = norm(error, to.y)};
  if (estimate.error <= 1) return estimate;
  const double over = safety * h / estimate.error;
  const double before = jumps.first * (to.t - from.t) - over / 2;
  estimate.shorter = std::min(std::max(over, before), safety * h);
  return estimate;
}

namespace {

State state_behind_jump(const System& system, const IntegratorSettings& settings,
                        Counters& counters, const State& before) {
  State state = before;
  state.branch.clear();
  std::string reason = AlgebraicSolver(system, counters).solve(state.t, state.y);
  if (reason.empty()) {
    set_rates(system, nullptr, state);
    return state;
  }
  if (settings.behind_jump) try {
      return settings.behind_jump(before);
    } catch (const SolutionError& error) {
      reason = error.what();
    }
  throw SolutionError(
      fmt::format("loads, friction or wear law jump at t = {:.6g} s, and behind the jump there "
                  "is no equilibrium: {}",
                  state.t, reason));
}

}  // namespace

bool pass_breakpoint(const System& system, const IntegratorSettings& settings, Counters& counters,
                     const ActiveSet* branch, State& state) {
  if (!loads_jump(system, state)) return set_rates_behind_jump(system, branch, state);
  state = state_behind_jump(system, settings, counters, state);
  return true;
}

}  // namespace gnomon
