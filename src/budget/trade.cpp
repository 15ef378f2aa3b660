#include "budget/trade.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::budget {

namespace {

/// An estimate may be wrong by a factor of two.
constexpr double used_part = 0.5;

/// Powers of the square root of two for elements, of ten for tolerances.
std::vector<double> choices(bool is_free, double base, int from, int to) {
  if (!is_free) return {1};
  std::vector<double> factors;
  for (int k = from; k >= to; --k) factors.push_back(std::pow(base, k / 2.0));
  return factors;
}

}  // namespace

PlanLine predicted(const Trade& trade, Factors factors) {
  PlanLine line;
  line.mesh = trade.mesh * std::pow(factors.mesh, Trade::order);
  line.time = trade.time * factors.time;
  line.model = trade.model;
  line.cpu_seconds = trade.seconds * std::pow(factors.mesh, -trade.cost_mesh) *
                     std::pow(factors.time, -trade.cost_time);
  return line;
}

Factors cheapest(const Trade& trade, double within) {
  const double target = used_part * within;
  // What cannot be changed is not made up for by the rest.
  const double fixed =
      trade.model + (trade.free_mesh ? 0 : trade.mesh) + (trade.free_time ? 0 : trade.time);
  const double rest = std::max(target - fixed, target / 4);
  Factors best;
  double least = std::numeric_limits<double>::infinity();
  for (const double mesh : choices(trade.free_mesh, 2, 8, -10))
    for (const double time : choices(trade.free_time, 10, 5, -10)) {
      const PlanLine line = predicted(trade, {mesh, time});
      const double error = (trade.free_mesh ? line.mesh : 0) + (trade.free_time ? line.time : 0);
      if (error > rest || line.cpu_seconds >= least) continue;
      least = line.cpu_seconds;
      best = {mesh, time};
    }
  if (!std::isfinite(least))
    return {trade.free_mesh ? std::exp2(-5) : 1, trade.free_time ? 1e-5 : 1};
  return best;
}

}  // namespace gnomon::budget
