// Mean wear rates over a cycle by two sets of phases.
#pragma once

#include <vector>

namespace gnomon {

/// Mean wear rates at the nodes of a surface, beside each other [volume / time].
struct RateDifference {
  double difference = 0;  ///< its absolute value summed up over the surface
  double whole = 0;       ///< of the second
};

/// By the area of each node and its two mean rates.
RateDifference compare_rates(const std::vector<double>& areas, const std::vector<double>& coarse,
                             const std::vector<double>& fine);

}  // namespace gnomon
