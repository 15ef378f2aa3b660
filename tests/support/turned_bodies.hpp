// Two bodies that are turned together: nothing may depend on their common frame.
#pragma once

#include "support/two_bodies.hpp"

namespace gnomon::testing {

/// On each other with a curved surface, of few elements.
template <int dim>
TwoBodies bodies_to_turn() {
  TwoBodies pair{.upper = {.along = 4, .high = 3, .wear = 1e-5},
                 .lower = {.along = 6, .high = 3, .wear = 2e-5},
                 .friction = 0.3};
  pair.lower.surface = [](double x) { return -0.02 * x * x; };
  if (dim == 2) return pair;
  pair.upper.along = pair.upper.high = pair.upper.across = 2;
  pair.lower.along = 3, pair.lower.high = 2, pair.lower.across = 2;
  return pair;
}

/// The largest difference of the states at the start and their rates, by the largest of them.
template <int dim>
double difference_of_starts(const AssemblyParts<dim>& one, const AssemblyParts<dim>& other) {
  Counters counters;
  const State a = WearModel<dim>(one).start(counters), b = WearModel<dim>(other).start(counters);
  double most = 0, size = 0;
  for (std::size_t k = 0; k < a.y.size(); ++k) {
    most = std::max({most, std::abs(a.y[k] - b.y[k]), std::abs(a.ydot[k] - b.ydot[k])});
    size = std::max({size, std::abs(a.y[k]), std::abs(a.ydot[k])});
  }
  return most / size;
}

}  // namespace gnomon::testing
