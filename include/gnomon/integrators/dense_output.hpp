// Dense output of one-step methods: a polynomial in time through the last states.
#pragma once

#include <deque>
#include <span>
#include <vector>

namespace gnomon {

/// Holds the last few states (stages and ends of steps), newest last. Gives first guesses for
/// solves and for the times of events, which are then computed exactly; no result depends on it.
class DenseOutput {
public:
  /// Adds a state, replacing one at the same time.
  void add(double t, std::span<const double> y);
  void clear() { points_.clear(); }

  /// Value at t of the polynomial through the nearest states: of the highest degree, up to three,
  /// whose weights stay bounded (a far extrapolation falls back to lower degrees). Zero without
  /// states.
  void evaluate(double t, std::span<double> y) const;

private:
  struct Entry {
    double t;
    std::vector<double> y;
  };
  std::deque<Entry> points_;
};

}  // namespace gnomon
