#include <algorithm>
#include <cmath>
#include <gnomon/laws/cycle.hpp>
#include <gnomon/laws/cycle_quadrature.hpp>
#include <numbers>
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

std::vector<double> Cycle::kinks() const {
  std::vector<double> all;
  for (const auto* function :
       {&displacement[0], &displacement[1], &displacement[2], &rotation, &force, &load}) {
    if (!*function) continue;
    const std::vector<double> own =
        (*function)->kinks(function == &rotation ? 2 * std::numbers::pi : 0);
    all = merged_kinks(std::move(all), own);
  }
  return all;
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
