// How the load of a run, or a given motion, changes with time.
#pragma once

#include <vector>

namespace gnomon {

/// A factor of the load, or a length, linear in time between given points, and constant before the
/// first of them and after the last.
class LoadHistory {
public:
  /// The whole load at all times.
  LoadHistory() = default;
  /// Equally many, one or more; `times` ascending, without equal ones.
  LoadHistory(std::vector<double> times, std::vector<double> factors);

  double factor(double t) const { return factor(t, t); }
  /// At t on the straight line that holds at the time `within`, and a moment later.
  double factor(double t, double within) const;
  /// The least factor from t = 0 to `end` [time].
  double least(double end) const;
  /// Of the factor, from t = 0 to `end` [time].
  double integral(double end) const;
  /// Where the factor may have a kink.
  const std::vector<double>& times() const { return times_; }

private:
  std::vector<double> times_ = {0}, factors_ = {1};
};

}  // namespace gnomon
