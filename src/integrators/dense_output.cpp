#include <algorithm>
#include <cmath>
#include <gnomon/integrators/dense_output.hpp>

namespace gnomon {

namespace {

/// The stages of the last two steps, seven in each for the longest table (esdirk-5). At every time
/// of interest at least four of them are nearer than older ones.
constexpr std::size_t capacity = 14;
/// A cubic. Stages are of order two or three in h, so a higher degree would interpolate their
/// errors.
constexpr std::size_t most_points = 4;
/// Sum of |weights|: how much an extrapolation may magnify errors of the states. From the
/// ends of equal steps, one step ahead: 3 by a line, 7 by a parabola, 15 by a cubic; two ahead: 5,
/// 17 and 49.
constexpr double largest_weights = 12;

}  // namespace

void DenseOutput::add(double t, std::span<const double> y) {
  std::erase_if(points_, [t](const Entry& point) { return point.t == t; });
  if (points_.size() == capacity) points_.pop_front();
  points_.push_back({t, {y.begin(), y.end()}});
}

void DenseOutput::evaluate(double t, std::span<double> y) const {
  std::vector<const Entry*> nearest;
  for (const Entry& point : points_) nearest.push_back(&point);
  std::sort(nearest.begin(), nearest.end(), [t](const Entry* a, const Entry* b) {
    return std::abs(a->t - t) < std::abs(b->t - t);
  });
  if (nearest.size() > most_points) nearest.resize(most_points);
  std::vector<double> weights;  // Lagrange's
  for (; !nearest.empty(); nearest.pop_back()) {
    weights.assign(nearest.size(), 1.0);
    double magnification = 0;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      for (std::size_t j = 0; j < nearest.size(); ++j)
        if (j != i) weights[i] *= (t - nearest[j]->t) / (nearest[i]->t - nearest[j]->t);
      magnification += std::abs(weights[i]);
    }
    if (magnification <= largest_weights) break;
  }
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t k = 0; k < nearest.size(); ++k)
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += weights[k] * nearest[k]->y[i];
}

}  // namespace gnomon
