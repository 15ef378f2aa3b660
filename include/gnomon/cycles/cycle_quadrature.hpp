// The phases of a cycle: positions at which the deformation is taken, and their parts of the mean
// over the cycle (docs/cycles.md, "Phases").
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace gnomon {

/// Positions in [0, 1), ascending, at which one of `count` functions of the position changes its
/// sign, also from the end of the cycle to its begin (sign_changes.hpp).
std::vector<double> sign_changes_in_cycle(
    const std::function<void(double tau, std::span<double> values)>& functions, std::size_t count);

/// The positions of both, ascending. Of those that are nearly the same, also around the end of the
/// cycle, the first: a corner of a table is also where a velocity changes its sign.
std::vector<double> merged_kinks(std::vector<double> kinks, const std::vector<double>& more);

/// A position in the cycle with its part of the mean over the cycle.
struct CyclePoint {
  double position = 0;  ///< tau
  double weight = 1;    ///< omega; the sum over the points is 1
};

/// Points of a path from 0 to 1, ascending, where history matters: ends of intervals, whose lengths
/// are the weights. All `extremes` inside are among them, whatever `count` is, and 1, the end.
std::vector<CyclePoint> path_points(int count, const std::vector<double>& extremes);

/// A quadrature over the cycle. `kinks`: positions in [0, 1), ascending, at which the integrand may
/// have a corner or a jump; they divide the cycle into as many parts.
class CycleQuadrature {
public:
  /// `count` points. Without kinks equal weights at 0, 1/P, ...: spectrally accurate for a smooth
  /// periodic integrand. With kinks Gauss's formula in each part, which gets about as many points
  /// as its length demands, one or more. With fewer points than parts, equal weights, and each
  /// point stands for its interval (stands_for_intervals()).
  CycleQuadrature(int count, std::vector<double> kinks);
  /// Chosen positions in [0, 1), ascending: each has half of the distances to its neighbours,
  /// around the cycle.
  CycleQuadrature(std::vector<double> positions, std::vector<double> kinks);

  /// Ascending.
  std::vector<CyclePoint> points() const;
  int parts() const { return static_cast<int>(kinks_.size()); }

  /// Whether there are fewer points than parts: functions that are known everywhere, as motions and
  /// loads are, then have their means over the interval of each point.
  bool stands_for_intervals() const;
  /// For each of points() a quadrature of its interval, which reaches half-way to its neighbours:
  /// between all kinks, with weights of the whole cycle. Only where the points are equal.
  std::vector<std::vector<CyclePoint>> intervals() const;

  /// So many times as many points, a power of two; between chosen positions their middles.
  CycleQuadrature refined(int times) const;
  /// The quadrature that this one is compared with, to estimate its error. Twice as many points,
  /// and twice as many as there are parts (up to 256), but none where this one has some: waves of P
  /// periods look alike at any of 0, 1/P, 2/P, ...
  CycleQuadrature comparison() const;
  /// Thousands of points, Gauss's between the kinks: for functions that cost nothing.
  std::vector<CyclePoint> fine_points() const;

private:
  int count_ = 0;                  ///< 0: chosen positions
  double shift_ = 0;               ///< of the first of equal points, a part of their distance
  std::vector<double> positions_;  ///< chosen ones
  std::vector<double> kinks_;
};

/// Chosen positions and the middles between them, around the cycle; all in [0, 1), ascending.
std::vector<double> with_middles(const std::vector<double>& positions);

}  // namespace gnomon
