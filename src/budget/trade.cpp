#include "budget/trade.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "budget/extrapolation.hpp"
#include "budget/wanted.hpp"

namespace gnomon::budget {

namespace {

/// Times the default tolerance: near the largest that controls steps.
const double loosest = std::pow(10.0, 2.5);

/// From the largest one, divided by powers of the fourth root of `base`.
std::vector<double> choices(bool is_free, double largest, double base) {
  constexpr int most = 24;  // 64 times as fine, a millionth of the tolerance
  if (!is_free) return {1};
  std::vector<double> factors;
  for (int k = 0; k <= most; ++k) factors.push_back(largest * std::pow(base, -k / 4.0));
  return factors;
}

}  // namespace

PlanLine predicted(const Trade& trade, Factors factors) {
  PlanLine line;
  line.mesh = trade.mesh * std::pow(factors.mesh, usual_order);
  line.time = trade.time * factors.time;
  line.rest = trade.rest;
  line.cpu_seconds = trade.seconds * std::pow(factors.mesh, -trade.cost_mesh) *
                     std::pow(factors.time, -trade.cost_time);
  return line;
}

namespace {

/// By elements of half the size: as a power of two.
double nodes_added(const Goals& coarse, const Goals& fine) {
  return std::log2(static_cast<double>(fine.nodes) / static_cast<double>(coarse.nodes));
}

}  // namespace

void learn_mesh(const Trial& coarse, const Trial& fine, double factor,
                const std::vector<std::size_t>& places, Trade& trade) {
  // Powers of CPU time: in space factors fill in, from n^(4/3) entries to n^2 operations.
  const double cost_of_nodes = fine.goals.surface.dim == 3 ? 1.6 : 1.2;
  constexpr double least_cost = 0.3;
  std::vector<double> errors = mesh_differences(coarse.goals, fine.goals);
  for (double& error : errors) error /= std::exp2(usual_order) - 1;
  respect_area(fine.goals, errors);
  // A difference may be small by chance, and that of a mesh that is too coarse is beyond all
  // bounds.
  constexpr double chance = 3, most_gain = 0.5;
  const double error = largest(errors, places) / std::pow(factor, usual_order);
  trade.mesh = std::clamp(most_gain * trade.mesh, error, chance * error);
  trade.cost_mesh = std::max({cost_of_nodes * nodes_added(coarse.goals, fine.goals),
                              std::log2(fine.work / coarse.work), least_cost});
  trade.seconds = fine.cpu_seconds * std::pow(factor, trade.cost_mesh);
}

Factors cheapest(const Trade& trade, double within) {
  return cheapest(trade, within / 2, within / 4);
}

Factors cheapest(const Trade& trade, double target, double least_rest) {
  const double fixed =
      trade.rest + (trade.free_mesh ? 0 : trade.mesh) + (trade.free_time ? 0 : trade.time);
  const double rest = std::max(target - fixed, least_rest);
  Factors best;
  double least = std::numeric_limits<double>::infinity();
  for (const double mesh : choices(trade.free_mesh, trade.coarsest, 2))
    for (const double time : choices(trade.free_time, loosest, 10)) {
      const PlanLine line = predicted(trade, {mesh, time});
      const double error = (trade.free_mesh ? line.mesh : 0) + (trade.free_time ? line.time : 0);
      if (error > rest || line.cpu_seconds >= least) continue;
      least = line.cpu_seconds;
      best = {mesh, time};
    }
  if (std::isfinite(least)) return best;
  // The finest mesh is not enough: smaller steps than its error would be in vain.
  best.mesh = choices(trade.free_mesh, trade.coarsest, 2).back();
  for (const double time : choices(trade.free_time, loosest, 10)) {
    best.time = time;
    const PlanLine line = predicted(trade, best);
    if (line.time <= std::max(line.mesh, rest) / 4) break;
  }
  return best;
}

}  // namespace gnomon::budget
