// When two times count as equal.
#pragma once

#include <cmath>

namespace gnomon {

/// Whether times differ only by rounding, as 0.1 * 3 from 0.3; otherwise there would be a step of
/// that length between them.
inline bool same_time(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::abs(b);
}

}  // namespace gnomon
