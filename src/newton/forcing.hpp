// How accurately a Newton step is solved for.
#pragma once

#include <algorithm>

namespace gnomon::sundials {

/// Residual that a linear solve has to reach, relative to its right side. `current` and `previous`
/// are the scaled residuals of this iterate and the last (zero: there is none).
///
/// With a fresh Jacobian the second choice of Eisenstat and Walker (SIAM J. Sci. Comput. 17 (1996)
/// 16), 0.9 (current / previous)^2: as accurate as the next contraction may be. A kept Jacobian
/// contracts by the same factor again, and a tenth of that is enough. Never below what ends the
/// iteration, nor looser than 1e-4: a step that does not resolve the sign of a contact node
/// switches it at random. The start of the groove (20x41x10 elements) takes 5 iterations so, and
/// with 0.05 fails after 15; an inner iteration costs a hundredth of a factorization.
inline double linear_reduction(double current, double previous, bool fresh, double tolerance) {
  constexpr double loosest = 1e-4, tightest = 1e-10, margin = 0.2;
  if (previous <= 0) return loosest;
  const double contraction = current / previous;
  const double reduction = fresh ? 0.9 * contraction * contraction : 0.1 * contraction;
  const double least = std::max(tightest, margin * tolerance / current);
  return std::clamp(reduction, std::min(least, loosest), loosest);
}

}  // namespace gnomon::sundials
