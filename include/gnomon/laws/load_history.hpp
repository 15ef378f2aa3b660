// The load of a run as a function of time.
#pragma once

#include <cstddef>
#include <vector>

namespace gnomon {

/// A factor of the load, or a length, linear in time between given points, and constant before the
/// first of them and after the last. Two factors at one time are a jump: the first holds before it,
/// the second after it.
class LoadHistory {
public:
  /// Factor one at all times.
  LoadHistory() = default;
  /// As many times as factors, at least one; `times` ascending, at most two of them equal.
  LoadHistory(std::vector<double> times, std::vector<double> factors);

  /// At a jump, that after it.
  double factor(double t) const { return factor(t, t); }
  /// The factor at t on the straight line that is valid immediately after the time `within`.
  double factor(double t, double within) const;
  /// The smallest factor from t = 0 to `end` [time].
  double least(double end) const;
  /// Integral of the factor from t = 0 to `end` [time].
  double integral(double end) const;
  /// The largest magnitude at any of times().
  double largest() const;
  /// The breakpoints: times at which the factor may have a kink or a jump.
  const std::vector<double>& times() const { return times_; }

  /// Whether times of a history are ascending, and at most two of them equal: the index of the
  /// first that is not, or their number.
  static std::size_t first_misplaced(const std::vector<double>& times);

private:
  std::vector<double> times_ = {0}, factors_ = {1};
};

}  // namespace gnomon
