#include "run/jump_ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/stop_times.hpp>

namespace gnomon {

JumpLedger::JumpLedger(const System& system, const IntegratorSettings& settings)
    : system_(system), passes_over_(settings.step > 0 && !settings.locate_events) {
  const std::vector<char>& may_jump = system.structure().switch_jumps;
  for (std::size_t j = 0; j < may_jump.size(); ++j)
    if (may_jump[j]) jumps_.push_back(j);
  turns_.resize(jumps_.size());
}

void JumpLedger::add(const State& before, const State& after) {
  // A node that slides crosses every few steps: of an explicit method once on the side that wears
  // fast, and then some times on the other. What a load drives to and fro begins anew where it
  // turns.
  constexpr int crossing = 3, many = 20;
  if (jumps_.empty()) return;
  const CrossedJumps crossed = jumps_between(system_, before, after, passes_over_);
  for (const std::size_t j : jumps_) largest_ = std::max(largest_, std::abs(crossed.before[j]));
  error_.resize(after.y.size());
  for (std::size_t i = 0; i < crossed.by.size(); ++i)
    error_[i] += (after.t - before.t) * std::abs(crossed.by[i]);
  if (is_breakpoint(system_.structure(), after.t)) std::ranges::fill(turns_, 0);
  for (std::size_t k = 0; k < jumps_.size(); ++k) {
    const bool here = std::ranges::count(crossed.functions, jumps_[k]) > 0;
    turns_[k] = here ? turns_[k] + crossing : std::max(0, turns_[k] - 1);
    if (turns_[k] < many) continue;
    turns_[k] = 0;
    if (!is_jump(before, after, jumps_[k])) continue;
    has_told_ = true;
    throw SolutionError(fmt::format(
        "the wear law jumps, and node {} slides along the jump at t = {:.6g} s: the rates on "
        "either side drive it back, and between them there is no solution; a ramp instead of the "
        "jump has one",
        system_.structure().switch_node[jumps_[k]], after.t));
  }
}

/// `if(p > p0, p - p0, 0)` does not.
bool JumpLedger::is_jump(const State& before, const State& after, std::size_t function) const try {
  constexpr double clear = 1e-3;  // of the largest rate
  double rate = 0;
  for (std::size_t i = 0; i < after.ydot.size(); ++i)
    if (system_.structure().differential[i]) rate = std::max(rate, std::abs(after.ydot[i]));
  return common_jump(system_, before, after, function) > clear * rate;
} catch (const RecoverableError&) {
  return true;
}

std::string JumpLedger::warning(const State& last) const {
  constexpr double right = 1e-3;
  double depth = 0, error = 0;
  for (std::size_t i = 0; i < error_.size(); ++i) {
    if (!system_.structure().differential[i]) continue;
    depth = std::max(depth, std::abs(last.y[i]));
    error = std::max(error, error_[i]);
  }
  if (!(error > right * depth)) return {};
  return fmt::format(
      "the wear law jumps within fixed steps: the wear depth has an error of up to {:.2g} mm by "
      "this, {:.2g} % of the largest depth",
      error, 100 * error / depth);
}

std::string JumpLedger::suspicion(const State& last) const {
  constexpr double there = 1e-5;
  if (jumps_.empty() || last.y.empty() || has_told_) return {};
  std::vector<double> values(system_.structure().switch_node.size());
  system_.switching({.t = last.t, .y = last.y}, values);
  for (const std::size_t j : jumps_)
    if (std::abs(values[j]) <= there * largest_)
      return fmt::format(
          "; the wear law jumps at node {} there, and an implicit step that ends near the jump may "
          "have no solution: with a ramp instead of the jump it has one, and explicit methods pass "
          "a jump unless the rates on either side drive the node back to it",
          system_.structure().switch_node[j]);
  return {};
}

}  // namespace gnomon
