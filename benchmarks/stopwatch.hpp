// Compares the times of parts of a loop.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace gnomon::bench {

/// Times of one part, one per pass. The parts that are compared run alternately in one loop, and
/// the median of the processor time is used, so that the influence of other work on the machine
/// cancels in the ratio.
class Stopwatch {
public:
  template <typename Part>
  void time(Part&& part) {
    const double begin = now();
    part();
    seconds_.push_back(now() - begin);
  }

  double median() const {
    std::vector<double> sorted = seconds_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }

private:
  static double now() {  // of all threads of the process
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::vector<double> seconds_;
};

}  // namespace gnomon::bench
