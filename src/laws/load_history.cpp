#include <algorithm>
#include <cmath>
#include <gnomon/laws/load_history.hpp>
#include <utility>

namespace gnomon {

LoadHistory::LoadHistory(std::vector<double> times, std::vector<double> factors)
    : times_(std::move(times)), factors_(std::move(factors)) {}

double LoadHistory::factor(double t, double within) const {
  const auto behind = std::upper_bound(times_.begin(), times_.end(), within);
  if (behind == times_.begin()) return factors_.front();
  if (behind == times_.end()) return factors_.back();
  const auto k = behind - times_.begin();
  const double part = (t - times_[k - 1]) / (times_[k] - times_[k - 1]);
  return (1 - part) * factors_[k - 1] + part * factors_[k];
}

double LoadHistory::least(double end) const {
  double least = std::min(factor(0), factor(end));
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (times_[k] < end) least = std::min(least, factors_[k]);
  return least;
}

double LoadHistory::largest() const {
  double most = 0;
  for (const double factor : factors_) most = std::max(most, std::abs(factor));
  return most;
}

std::size_t LoadHistory::first_misplaced(const std::vector<double>& times) {
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] >= times[k - 1]) || (k > 1 && times[k] == times[k - 2])) return k;
  return times.size();
}

double LoadHistory::integral(double end) const {
  double sum = 0, from = 0;
  const auto add_up_to = [&](double to) {
    if (to <= from) return;
    sum += (to - from) * (factor(from) + factor(to, from)) / 2;
    from = to;
  };
  for (const double time : times_) add_up_to(std::min(time, end));
  add_up_to(end);
  return sum;
}

}  // namespace gnomon
