// Follows the equilibria of a growing load, from zero to the whole load.
#pragma once

#include <functional>
#include <gnomon/newton/newton.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Increments are fractions of the load.
struct RampOptions {
  double first = 1;        ///< first increment, in (0, 1]
  double largest = 1;      ///< upper bound of increments
  double smallest = 1e-4;  ///< lower bound, except for the last; the ramp ends if this one fails
  int most = 1000;         ///< largest number of solves: for absurd loads increments are tiny
  int good_iterations =
      3;  ///< Newton iterations per increment: with fewer the next grows, with more it shrinks
};

struct RampReport {
  double reached = 0;  ///< fraction of the load that is in equilibrium; 1 on success
  int increments = 0;  ///< number that converged
  int failures = 0;    ///< number of attempts that did not
  std::string reason;  ///< of the last failure when reached < 1
};

/// Solves for the equilibrium at a fraction of the load, in place, from a guess.
using LoadSolve = std::function<NewtonReport(double fraction, std::span<double> y)>;

/// From y without load to y with all of it. The guess of each increment is the secant through the
/// last two equilibria; a failed increment is halved, and the next one grows by at most a half.
/// If the ramp fails, y is the last equilibrium.
RampReport ramp_load(const LoadSolve& solve, const RampOptions& options, std::vector<double>& y);

}  // namespace gnomon
