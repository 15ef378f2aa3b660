#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/cycles/cycle.hpp>
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <numbers>
#include <span>

namespace gnomon {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;
constexpr double end = 1 - 1e-12;  // of a cycle, where it has not yet begun again

/// Spread over the cycle so that no shorter period hides from them.
std::array<double, 100> sampled_positions() {
  std::array<double, 100> positions{};
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k] = std::fmod(static_cast<double>(k) * std::numbers::phi, 1.0);
  return positions;
}

}  // namespace

CycleFunction::CycleFunction(Expression expression) : expression_(std::move(expression)) {}

double CycleFunction::value(double tau) const {
  return expression_.value(std::span(&tau, 1));
}

double CycleFunction::slope(double tau) const {
  // Expressions have the slope of what is before a kink: before 0 a table is constant.
  constexpr double ahead = 1e-13;
  double slope = 0;
  const double after = tau + ahead;
  expression_.value_and_gradient(std::span(&after, 1), std::span(&slope, 1));
  return slope;
}

std::vector<double> CycleFunction::kinks(double turn) const {
  std::vector<double> found = sign_changes_in_cycle(
      [this](double tau, std::span<double> values) {
        expression_.switching(std::span(&tau, 1), values);
      },
      expression_.kinks());
  double size = 0, steepness = 0;
  for (const double tau : sampled_positions()) {
    size = std::max(size, std::abs(value(tau)));
    steepness = std::max(steepness, std::abs(slope(tau)));
  }
  const bool ends_as_it_begins = std::abs(gap(turn)) <= 1e-9 * size + (1 - end) * steepness &&
                                 std::abs(slope(end) - slope(0)) <= 1e-9 * steepness;
  if (!ends_as_it_begins && (found.empty() || found.front() > 0)) found.insert(found.begin(), 0);
  return found;
}

double CycleFunction::gap(double turn) const {
  const double jump = value(end) - value(0);
  return turn > 0 ? std::remainder(jump, turn) : jump;
}

double CycleFunction::range() const {
  double most = 0;
  for (const double tau : sampled_positions())
    most = std::max(most, std::abs(value(tau) - value(0)));
  return most;
}

std::vector<double> Cycle::kinks() const {
  std::vector<double> all;
  for (const auto* function :
       {&displacement[0], &displacement[1], &displacement[2], &rotation, &force, &load}) {
    if (!*function) continue;
    const std::vector<double> own = (*function)->kinks(function == &rotation ? whole_turn : 0);
    all = merged_kinks(std::move(all), own);
  }
  return all;
}

std::vector<std::string> Cycle::remarks() const {
  constexpr double rounding = 1e-6;
  std::vector<std::string> found;
  const auto look_at = [&](const std::string& name, const std::optional<CycleFunction>& function,
                           double turn, const std::string& unit) {
    if (!function) return;
    const double gap = function->gap(turn);
    if (std::abs(gap) > rounding * function->range())
      found.push_back(fmt::format(
          "cycle.{} ends {:.3g} {} from where it begins: the next cycle begins there again, and "
          "nothing slides on this way",
          name, std::abs(gap), unit));
  };
  look_at("x", displacement[0], 0, "mm");
  look_at("y", displacement[1], 0, "mm");
  look_at("z", displacement[2], 0, "mm");
  look_at("rotation", rotation, whole_turn, "rad");
  return found;
}

template <int dim>
Vector<dim> displacement_at(const Cycle& cycle, double tau) {
  Vector<dim> displaced = Vector<dim>::Zero();
  for (int i = 0; i < dim; ++i)
    if (cycle.displacement[i]) displaced[i] = cycle.displacement[i]->value(tau);
  return displaced;
}

template <int dim>
void add_velocity(const Cycle& cycle, const CycleAxis<dim>& axis, double tau,
                  RigidMotion<dim>& motion) {
  for (int i = 0; i < 3; ++i)
    if (cycle.displacement[i])
      (i < dim ? motion.velocity[i] : motion.across) +=
          cycle.displacement[i]->slope(tau) / cycle.period;
  if (!cycle.rotation) return;
  const double rate = cycle.rotation->slope(tau) / cycle.period;
  if (axis.meridian) {
    motion.across_by_x[0] += rate;
    return;
  }
  motion.spin += rate * axis.spin;
  motion.velocity -= rate * axis.spin * axis.centre;
}

template <int dim>
CounterBody<dim> counter_body_at(const CounterBody<dim>& body, const Cycle& cycle,
                                 const CycleAxis<dim>& axis, double tau) {
  CounterBody<dim> result = body;
  result.position += displacement_at<dim>(cycle, tau);
  add_velocity(cycle, axis, tau, result.motion);
  if (cycle.rotation && axis.turns_shape)
    result.turning = Turning<dim>{axis.spin, axis.centre, 0, cycle.rotation->value(tau)};
  return result;
}

template Vector<2> displacement_at(const Cycle&, double);
template Vector<3> displacement_at(const Cycle&, double);
template void add_velocity(const Cycle&, const CycleAxis<2>&, double, RigidMotion<2>&);
template void add_velocity(const Cycle&, const CycleAxis<3>&, double, RigidMotion<3>&);
template CounterBody<2> counter_body_at(const CounterBody<2>&, const Cycle&, const CycleAxis<2>&,
                                        double);
template CounterBody<3> counter_body_at(const CounterBody<3>&, const Cycle&, const CycleAxis<3>&,
                                        double);

}  // namespace gnomon
