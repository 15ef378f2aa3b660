#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/cycles/compared_rates.hpp>

namespace gnomon {

RateDifference compare_rates(const std::vector<double>& areas, const std::vector<double>& coarse,
                             const std::vector<double>& fine) {
  RateDifference result;
  for (std::size_t c = 0; c < areas.size(); ++c) {
    result.difference += areas[c] * std::abs(coarse[c] - fine[c]);
    result.whole += areas[c] * std::abs(fine[c]);
  }
  return {sum_over_processes(result.difference), sum_over_processes(result.whole)};
}

}  // namespace gnomon
