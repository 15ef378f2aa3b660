// How accurately a Newton step is solved for.
#pragma once

#include <algorithm>

namespace gnomon::sundials {

/// Residual that a linear solve has to reach, relative to its right side. `current` and `previous`
/// are the scaled residuals of this iterate and the last (zero: there is none).
///
/// With a fresh Jacobian the second choice of Eisenstat and Walker (SIAM J. Sci. Comput. 17 (1996)
/// 16), 0.9 (current / previous)^2: as accurate as the next contraction may be. A kept Jacobian
/// contracts by the same factor again, and a tenth of that is enough. Never so loose that Newton
/// takes it for slow contraction, nor below what ends the iteration. Near its end an iteration that
/// stalls counts as stopped by rounding, so there the solve must not be what stalls it.
inline double linear_reduction(double current, double previous, bool fresh, double tolerance) {
  constexpr double first = 1e-2, tightest = 1e-10, margin = 0.2, near_end = 1e4;
  const double loosest = current <= near_end * tolerance ? 1e-4 : 0.05;
  const double contraction = previous > 0 ? current / previous : 0;
  double reduction = first;
  if (previous > 0) reduction = fresh ? 0.9 * contraction * contraction : 0.1 * contraction;
  const double least = std::max(tightest, margin * tolerance / current);
  return std::clamp(reduction, std::min(least, loosest), loosest);
}

}  // namespace gnomon::sundials
