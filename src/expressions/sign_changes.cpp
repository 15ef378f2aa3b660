#include <algorithm>
#include <cmath>
#include <gnomon/expressions/sign_changes.hpp>

namespace gnomon {

namespace {

constexpr int parts = 2000;
constexpr double least_part = 1e-15;  // of the run: what is earlier is at its start

class Search {
public:
  Search(const TimeFunctions& functions, std::size_t count, double end)
      : functions_(functions), values_(count), end_(end) {
    for (int k = 0; k <= parts; ++k) {
      times_.push_back(end * k / parts);
      functions_(times_.back(), values_);
      samples_.push_back(values_);
    }
  }

  /// Adds the sign changes of one function.
  void find(std::size_t which, std::vector<double>& found) const {
    std::vector<double> times = {times_.front()};
    for (int k = 1; k <= parts; ++k) {
      if (k < parts && is_least(which, k)) times.push_back(towards_zero(which, k));
      times.push_back(times_[k]);
    }
    std::sort(times.begin(), times.end());
    double before = value(which, times.front());
    for (std::size_t k = 1; k < times.size(); ++k) {
      const double after = value(which, times[k]);
      if (active(before) != active(after)) found.push_back(between(which, times[k - 1], times[k]));
      before = after;
    }
  }

private:
  static bool active(double value) { return value <= 0; }

  double value(std::size_t which, double t) const {
    functions_(t, values_);
    return values_[which];
  }

  /// Whether the magnitude has a minimum near a sample, without a change of sign beside it.
  bool is_least(std::size_t which, int k) const {
    const double a = samples_[k - 1][which], b = samples_[k][which], c = samples_[k + 1][which];
    if (active(a) != active(b) || active(b) != active(c)) return false;
    const double left = std::abs(a), here = std::abs(b), right = std::abs(c);
    return here <= left && here <= right && (here < left || here < right);
  }

  /// Golden-section search for the minimum around sample k, which ends where the sign is another.
  double towards_zero(std::size_t which, int k) const {
    constexpr int most = 80;
    const double ratio = (std::sqrt(5.0) - 1) / 2;
    const bool own = active(samples_[k][which]);
    double low = times_[k - 1], high = times_[k + 1];
    for (int i = 0; i < most && high - low > 1e-15 * end_; ++i) {
      const double left = high - ratio * (high - low), right = low + ratio * (high - low);
      const double at_left = value(which, left), at_right = value(which, right);
      if (active(at_left) != own) return left;
      if (active(at_right) != own) return right;
      (std::abs(at_left) < std::abs(at_right) ? high : low) =
          std::abs(at_left) < std::abs(at_right) ? right : left;
    }
    return (low + high) / 2;
  }

  /// By bisection to the last digit, at zero to that of the run.
  double between(std::size_t which, double low, double high) const {
    const bool first = active(value(which, low));
    for (double middle = (low + high) / 2;
         middle > low && middle < high && high > least_part * end_; middle = (low + high) / 2)
      (active(value(which, middle)) == first ? low : high) = middle;
    return std::abs(value(which, low)) < std::abs(value(which, high)) ? low : high;
  }

  const TimeFunctions& functions_;
  mutable std::vector<double> values_;
  double end_;
  std::vector<double> times_;
  std::vector<std::vector<double>> samples_;
};

}  // namespace

std::vector<double> sign_changes(const TimeFunctions& functions, std::size_t count,
                                 const std::vector<std::size_t>& which, double end) {
  std::vector<double> found;
  if (which.empty()) return found;
  const Search search(functions, count, end);
  for (const std::size_t function : which) search.find(function, found);
  std::erase_if(found, [&](double t) { return !(t > least_part * end); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace gnomon
