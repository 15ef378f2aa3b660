// Error and cost as powers of the sizes of elements and of the tolerance in time.
#pragma once

#include <gnomon/budget/plan.hpp>
#include <vector>

#include "budget/trial.hpp"

namespace gnomon::budget {

/// At the scene's own values of the keys that control mesh and time (factors 1), and how they
/// change with factors of these: errors with mesh^usual_order and time^1, cost with mesh^-cost_mesh
/// and time^-cost_time.
struct Trade {
  double mesh = 0, time = 0;  ///< relative errors
  double rest = 0;            ///< of model and phases, which stay
  double seconds = 0;
  double cost_mesh = 2.4, cost_time = 0.3;
  double coarsest = 1;  ///< mesh factor: on larger elements contact has too few nodes
  bool free_mesh = false, free_time = false;  ///< whether their factors may change
};

/// Factors of the two.
struct Factors {
  double mesh = 1, time = 1;
};

PlanLine predicted(const Trade& trade, Factors factors);

/// The cheapest factors whose error is at most half of `within`, because estimates are wrong by a
/// factor of two. Errors that cannot be changed, as those of given settings, leave at least half of
/// that to the others: what they spoil is not made up for by a mesh of any cost.
Factors cheapest(const Trade& trade, double within);
/// Those whose error is at most `target`; what cannot be changed leaves at least `least_rest`.
/// Where no factors reach this: the finest mesh, and steps that suit it.
Factors cheapest(const Trade& trade, double target, double least_rest);

/// What a pilot on elements of `factor` times a size, and one on twice as large ones, tell of the
/// mesh: its cost, and its error in the wanted places. Where that is less than half of what coarser
/// pilots have told, it is taken for larger, up to three times.
void learn_mesh(const Trial& coarse, const Trial& fine, double factor,
                const std::vector<std::size_t>& places, Trade& trade);

}  // namespace gnomon::budget
