#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gnomon/laws/cycle.hpp>
#include <gnomon/laws/sign_changes.hpp>
#include <numbers>
#include <numeric>
#include <span>

namespace gnomon {

CycleFunction::CycleFunction(Expression expression) : expression_(std::move(expression)) {}

double CycleFunction::value(double tau) const {
  return expression_.value(std::span(&tau, 1));
}

double CycleFunction::slope(double tau) const {
  double slope = 0;
  expression_.value_and_gradient(std::span(&tau, 1), std::span(&slope, 1));
  return slope;
}

std::vector<double> CycleFunction::kinks(double turn) const {
  std::vector<double> found = sign_changes_in_cycle(
      [this](double tau, std::span<double> values) {
        expression_.switching(std::span(&tau, 1), values);
      },
      expression_.kinks());
  const double end = 1 - 1e-12;
  double size = 0, steepness = 0;
  for (int k = 0; k < 100; ++k) {
    size = std::max(size, std::abs(value(k / 100.0)));
    steepness = std::max(steepness, std::abs(slope(k / 100.0)));
  }
  double jump = value(end) - value(0);
  if (turn > 0) jump = std::remainder(jump, turn);
  const bool ends_as_it_begins =
      std::abs(jump) <= 1e-9 * size && std::abs(slope(end) - slope(0)) <= 1e-9 * steepness;
  if (!ends_as_it_begins && (found.empty() || found.front() > 0)) found.insert(found.begin(), 0);
  return found;
}

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
  kinks.insert(kinks.end(), more.begin(), more.end());
  std::sort(kinks.begin(), kinks.end());
  constexpr double same = 1e-9;
  kinks.erase(
      std::unique(kinks.begin(), kinks.end(), [](double a, double b) { return b - a < same; }),
      kinks.end());
  return kinks;
}

std::vector<double> Cycle::kinks() const {
  std::vector<double> all;
  for (const auto* function :
       {&displacement[0], &displacement[1], &displacement[2], &rotation, &force, &load}) {
    if (!*function) continue;
    const std::vector<double> own =
        (*function)->kinks(function == &rotation ? 2 * std::numbers::pi : 0);
    all.insert(all.end(), own.begin(), own.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace {

/// Gauss's points in (0, 1) and their weights: eigenvalues of the matrix of Legendre's recurrence,
/// and squares of the first components of its eigenvectors (G. Golub and J. Welsch, Math. Comp. 23
/// (1969) 221).
std::vector<CyclePoint> gauss_points(int count) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd beside(std::max(0, count - 1));
  for (int k = 1; k < count; ++k) beside[k - 1] = k / std::sqrt(4.0 * k * k - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  std::vector<CyclePoint> points;
  for (int k = 0; k < count; ++k) {
    const double first = solver.eigenvectors()(0, k);
    points.push_back({(1 + solver.eigenvalues()[k]) / 2, first * first});
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

}  // namespace

std::vector<CyclePoint> cycle_points(int count, const std::vector<double>& kinks) {
  std::vector<CyclePoint> points;
  if (kinks.empty() || count < static_cast<int>(kinks.size())) {
    for (int p = 0; p < count; ++p) points.push_back({double(p) / count, 1.0 / count});
    return points;
  }
  std::vector<double> lengths;
  for (std::size_t k = 0; k < kinks.size(); ++k)
    lengths.push_back(k + 1 < kinks.size() ? kinks[k + 1] - kinks[k]
                                           : 1 + kinks.front() - kinks.back());
  const std::vector<int> shares = share(count, lengths);
  for (std::size_t k = 0; k < kinks.size(); ++k)
    for (const CyclePoint& point : gauss_points(shares[k])) {
      const double tau = kinks[k] + lengths[k] * point.position;
      points.push_back({tau < 1 ? tau : tau - 1, lengths[k] * point.weight});
    }
  std::sort(points.begin(), points.end(),
            [](const CyclePoint& a, const CyclePoint& b) { return a.position < b.position; });
  return points;
}

std::vector<CyclePoint> cycle_points(const std::vector<double>& positions) {
  std::vector<CyclePoint> points;
  const std::size_t count = positions.size();
  for (std::size_t p = 0; p < count; ++p) {
    const double before = p == 0 ? positions.back() - 1 : positions[p - 1];
    const double behind = p + 1 == count ? positions.front() + 1 : positions[p + 1];
    points.push_back({positions[p], (behind - before) / 2});
  }
  return points;
}

std::vector<double> with_middles(const std::vector<double>& positions) {
  std::vector<double> result = positions;
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const double next = p + 1 < positions.size() ? positions[p + 1] : positions.front() + 1;
    const double middle = (positions[p] + next) / 2;
    result.push_back(middle < 1 ? middle : middle - 1);
  }
  std::sort(result.begin(), result.end());
  return result;
}

namespace {

/// Adds the displacement and its velocity.
template <int dim>
void displace(const Cycle& cycle, double tau, CounterBody<dim>& body) {
  for (int i = 0; i < 3; ++i) {
    if (!cycle.displacement[i]) continue;
    const double speed = cycle.displacement[i]->slope(tau) / cycle.period;
    if (i < dim) {
      body.position[i] += cycle.displacement[i]->value(tau);
      body.motion.velocity[i] += speed;
    } else {
      body.motion.across += speed;
    }
  }
}

template <int dim>
void turn(const Cycle& cycle, const CycleAxis<dim>& axis, double tau, CounterBody<dim>& body) {
  const double rate = cycle.rotation->slope(tau) / cycle.period;
  if (axis.meridian) {
    body.motion.across_by_x[0] += rate;
    return;
  }
  body.motion.spin += rate * axis.spin;
  body.motion.velocity -= rate * axis.spin * axis.centre;
  if (axis.turns_shape)
    body.turning = Turning<dim>{axis.spin, axis.centre, 0, cycle.rotation->value(tau)};
}

}  // namespace

template <int dim>
CounterBody<dim> counter_body_at(const CounterBody<dim>& body, const Cycle& cycle,
                                 const CycleAxis<dim>& axis, double tau) {
  CounterBody<dim> result = body;
  displace(cycle, tau, result);
  if (cycle.rotation) turn(cycle, axis, tau, result);
  return result;
}

template CounterBody<2> counter_body_at(const CounterBody<2>&, const Cycle&, const CycleAxis<2>&,
                                        double);
template CounterBody<3> counter_body_at(const CounterBody<3>&, const Cycle&, const CycleAxis<3>&,
                                        double);

}  // namespace gnomon
