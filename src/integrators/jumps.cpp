#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

namespace gnomon {

namespace {

/// F on another branch less F on the own one is the jump of the rates, where both have a value.
std::vector<double> jump_of_rates(const System& system, const State& from, const State& to,
                                  const ActiveSet& own, const ActiveSet& other) {
  std::vector<double> here(to.y.size()), there(to.y.size());
  try {
    system.residual({to.t, to.y, to.ydot, &own, from.t}, here);
    system.residual({to.t, to.y, to.ydot, &other, from.t}, there);
  } catch (const RecoverableError&) {
    return std::vector<double>(to.y.size());
  }
  const std::vector<char>& differential = system.structure().differential;
  for (std::size_t i = 0; i < here.size(); ++i) here[i] = differential[i] ? there[i] - here[i] : 0;
  return here;
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
  std::vector<double> before(may_jump.size()), after(may_jump.size());
  system.switching({.t = from.t, .y = from.y, .ydot = from.ydot}, before);
  system.switching({.t = to.t, .y = to.y, .ydot = to.ydot}, after);
  ActiveSet own, other;
  for (std::size_t j = 0; j < may_jump.size(); ++j) {
    own.push_back(after[j] <= 0);
    other.push_back(may_jump[j] ? before[j] <= 0 : own.back());
    const bool crossed = own.back() != other.back();
    if (!crossed) continue;
    found.functions.push_back(j);
    found.first = std::min(found.first, before[j] / (before[j] - after[j]));
  }
  if (size && !on_all_processes(found.functions.empty()))
    found.by = jump_of_rates(system, from, to, own, other);
  found.before = std::move(before);
  return found;
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

bool pass_breakpoint(const System& system, Counters& counters, const ActiveSet* branch,
                     State& state) {
  if (!loads_jump(system, state)) return set_rates_behind_jump(system, branch, state);
  state.branch.clear();
  const std::string reason = AlgebraicSolver(system, counters).solve(state.t, state.y);
  if (!reason.empty())
    throw SolutionError(
        fmt::format("loads, friction or wear law jump at t = {:.6g} s, and behind the jump there "
                    "is no equilibrium: {}",
                    state.t, reason));
  set_rates(system, nullptr, state);
  return true;
}

}  // namespace gnomon
