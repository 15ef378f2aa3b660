// Follows the equilibria of a growing load, from none to the whole.
#pragma once

#include <functional>
#include <gnomon/newton/newton.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Increments are fractions of the load.
struct RampOptions {
  double first = 1;         ///< tried at first, in (0, 1]
  double largest = 1;       ///< none is larger
  double smallest = 1e-4;   ///< none is smaller but the last; the ramp ends when this one fails
  int most = 1000;          ///< solves, after which the ramp ends: towards absurd loads it creeps
  int good_iterations = 3;  ///< of Newton in an increment: fewer make the next larger, more smaller
};

struct RampReport {
  double reached = 0;  ///< fraction of the load that is in equilibrium; 1 when all went well
  int increments = 0;  ///< that converged
  int failures = 0;    ///< attempts that did not
  std::string reason;  ///< of the last failure when reached < 1
};

/// Solves for the equilibrium at a fraction of the load, in place from a guess.
using LoadSolve = std::function<NewtonReport(double fraction, std::span<double> y)>;

/// From y without load to y with all of it. The guess of each increment is the secant through the
/// last two equilibria; a failed increment is halved, and the next one grows by at most a half.
/// When it fails, y is the last equilibrium.
RampReport ramp_load(const LoadSolve& solve, const RampOptions& options, std::vector<double>& y);

}  // namespace gnomon
