#include <algorithm>
#include <cmath>
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <gnomon/expressions/sign_changes.hpp>
#include <numeric>

#include "base/spectrum.hpp"

namespace gnomon {

std::vector<double> sign_changes_in_cycle(
    const std::function<void(double tau, std::span<double> values)>& functions, std::size_t count) {
  // The search begins inside, where hardly any function changes its sign.
  constexpr double begin = 0.123456789;
  const auto position = [](double t) { return begin + t < 1 ? begin + t : begin + t - 1; };
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<double> found = sign_changes(
      [&](double t, std::span<double> values) { functions(position(t), values); }, count, all, 1);
  constexpr double rounding = 1e-12;
  for (double& t : found) {
    t = position(t);
    if (t < rounding || t > 1 - rounding) t = 0;
  }
  std::sort(found.begin(), found.end());
  found.erase(
      std::unique(found.begin(), found.end(), [](double a, double b) { return b - a < rounding; }),
      found.end());
  return found;
}

std::vector<double> merged_kinks(std::vector<double> kinks, const std::vector<double>& more) {
  constexpr double same = 1e-9;  // as accurate as sign changes are found, and more
  kinks.insert(kinks.end(), more.begin(), more.end());
  std::sort(kinks.begin(), kinks.end());
  std::vector<double> merged;
  for (const double kink : kinks)
    if (merged.empty() || kink - merged.back() >= same) merged.push_back(kink);
  if (merged.size() > 1 && merged.front() + 1 - merged.back() < same) merged.pop_back();
  return merged;
}

namespace {

/// Gauss's points in (0, 1) and their weights: eigenvalues of the matrix of Legendre's recurrence,
/// and squares of the first components of its eigenvectors (G. Golub and J. Welsch, Math. Comp. 23
/// (1969) 221).
std::vector<CyclePoint> gauss_points(int count) {
  Eigen::MatrixXd recurrence = Eigen::MatrixXd::Zero(count, count);
  for (int k = 1; k < count; ++k)
    recurrence(k, k - 1) = recurrence(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const auto [values, vectors] = spectrum_of(recurrence);
  std::vector<CyclePoint> points;
  for (int k = 0; k < count; ++k) {
    const double first = vectors(0, k);
    points.push_back({(1 + values[k]) / 2, first * first});
  }
  return points;
}

/// How many of `count` points each part gets, one or more, by its length: the next point goes where
/// a point stands for most.
std::vector<int> share(int count, const std::vector<double>& lengths) {
  std::vector<int> points(lengths.size(), 1);
  for (int k = static_cast<int>(lengths.size()); k < count; ++k) {
    std::size_t neediest = 0;
    for (std::size_t i = 1; i < lengths.size(); ++i)
      if (lengths[i] * points[neediest] > lengths[neediest] * points[i]) neediest = i;
    ++points[neediest];
  }
  return points;
}

/// Of points that are compared with others: far from all simple fractions.
constexpr double golden_section = 0.381966011250105;

std::vector<CyclePoint> equal_points(int count, double shift) {
  std::vector<CyclePoint> points;
  for (int p = 0; p < count; ++p) points.push_back({(p + shift) / count, 1.0 / count});
  return points;
}

/// Points of Gauss's formula from `begin` on, around the cycle.
void add_part(double begin, double length, const std::vector<CyclePoint>& gauss,
              std::vector<CyclePoint>& points) {
  for (const CyclePoint& point : gauss) {
    const double tau = begin + length * point.position;
    points.push_back({tau < 1 ? tau : tau - 1, length * point.weight});
  }
}

/// From each of ascending positions in [0, 1) to the next, around the cycle.
std::vector<double> distances(const std::vector<double>& positions) {
  std::vector<double> lengths;
  for (std::size_t k = 0; k + 1 < positions.size(); ++k)
    lengths.push_back(positions[k + 1] - positions[k]);
  if (!positions.empty()) lengths.push_back(1 + positions.front() - positions.back());
  return lengths;
}

/// `times` as many as the part of each of `count` points.
std::vector<CyclePoint> points_between(int count, const std::vector<double>& kinks, int times) {
  const std::vector<double> lengths = distances(kinks);
  const std::vector<int> shares = share(count, lengths);
  std::vector<CyclePoint> points;
  for (std::size_t k = 0; k < kinks.size(); ++k)
    add_part(kinks[k], lengths[k], gauss_points(times * shares[k]), points);
  std::ranges::sort(points, {}, &CyclePoint::position);
  return points;
}

/// Four points in each of about a thousand panels, which end at all kinks and `more` positions.
std::vector<CyclePoint> fine_between(std::vector<double> kinks, const std::vector<double>& more) {
  constexpr int panels = 1024;
  kinks.insert(kinks.end(), more.begin(), more.end());
  for (int k = 0; k < panels; ++k) kinks.push_back(double(k) / panels);
  std::ranges::sort(kinks);
  const std::vector<double> lengths = distances(kinks);
  const std::vector<CyclePoint> gauss = gauss_points(4);
  std::vector<CyclePoint> points;
  for (std::size_t k = 0; k < kinks.size(); ++k)
    if (lengths[k] > 0) add_part(kinks[k], lengths[k], gauss, points);
  return points;
}

}  // namespace

std::vector<CyclePoint> path_points(int count, const std::vector<double>& extremes) {
  constexpr double rounding = 1e-9;
  std::vector<double> ends;
  for (const double tau : extremes)
    if (tau > rounding && tau < 1 - rounding) ends.push_back(tau);
  ends.push_back(1);
  std::vector<double> lengths;
  for (std::size_t k = 0; k < ends.size(); ++k)
    lengths.push_back(ends[k] - (k == 0 ? 0 : ends[k - 1]));
  const std::vector<int> shares = share(count, lengths);
  std::vector<CyclePoint> points;
  for (std::size_t k = 0; k < ends.size(); ++k)
    for (int j = 1; j <= shares[k]; ++j) {
      const double length = lengths[k] / shares[k];
      points.push_back({ends[k] - (shares[k] - j) * length, length});
    }
  return points;
}

CycleQuadrature::CycleQuadrature(int count, std::vector<double> kinks)
    : count_(count), kinks_(std::move(kinks)) {}

CycleQuadrature::CycleQuadrature(std::vector<double> positions, std::vector<double> kinks)
    : positions_(std::move(positions)), kinks_(std::move(kinks)) {}

std::vector<CyclePoint> CycleQuadrature::points() const {
  if (count_ > 0 && (kinks_.empty() || stands_for_intervals())) return equal_points(count_, shift_);
  // What is compared has twice the points of each part: else a short one would keep its only one.
  const int times = shift_ == golden_section ? 2 : 1;
  if (count_ > 0) return points_between(count_ / times, kinks_, times);
  std::vector<CyclePoint> points;
  const std::vector<double> behind = distances(positions_);
  for (std::size_t p = 0; p < positions_.size(); ++p) {
    const double before = p == 0 ? behind.back() : behind[p - 1];
    points.push_back({positions_[p], (before + behind[p]) / 2});
  }
  return points;
}

bool CycleQuadrature::stands_for_intervals() const {
  return count_ > 0 && count_ < parts();
}

std::vector<std::vector<CyclePoint>> CycleQuadrature::intervals() const {
  const auto border = [this](double p) {
    const double tau = (p + shift_ - 0.5) / count_;
    return tau < 0 ? tau + 1 : tau;
  };
  std::vector<double> borders;
  for (int p = 0; p < count_; ++p) borders.push_back(border(p));
  std::vector<std::vector<CyclePoint>> intervals(count_);
  for (const CyclePoint& point : fine_between(kinks_, borders)) {
    const auto p = static_cast<int>(std::floor(point.position * count_ - shift_ + 0.5));
    intervals[(p + count_) % count_].push_back(point);
  }
  return intervals;
}

CycleQuadrature CycleQuadrature::refined(int times) const {
  CycleQuadrature result = *this;
  result.count_ *= times;
  if (count_ == 0)
    for (int finer = 1; finer < times; finer *= 2)
      result.positions_ = with_middles(result.positions_);
  return result;
}

CycleQuadrature CycleQuadrature::comparison() const {
  if (count_ == 0) return refined(2);
  constexpr int most_by_parts = 256;
  CycleQuadrature result = *this;
  result.count_ = std::max(2 * count_, std::min(2 * parts(), most_by_parts));
  result.shift_ = golden_section;
  return result;
}

std::vector<CyclePoint> CycleQuadrature::fine_points() const {
  return fine_between(kinks_, {});
}

std::vector<double> with_middles(const std::vector<double>& positions) {
  std::vector<double> result = positions;
  const std::vector<double> behind = distances(positions);
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const double middle = positions[p] + behind[p] / 2;
    result.push_back(middle < 1 ? middle : middle - 1);
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace gnomon
