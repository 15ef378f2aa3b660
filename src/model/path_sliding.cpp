// The first loading where friction is so small that Newton's method does not find what sticks.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/path_phase.hpp"
#include "model/phase_start.hpp"
#include "model/wear_start.hpp"

namespace gnomon {

/// A guess of the tractions, by a part of friction: each node slips as without friction, relative
/// to a node in the middle. That one begins as stuck, since friction alone may hold a body.
template <int dim>
NodalField<dim> PathMarch<dim>::slipping(const std::vector<ContactNode<dim>>& nodes,
                                         double part) const {
  constexpr double beyond = 2;
  double friction = near_->interface.friction;
  for (const MortarPair<dim>& pair : near_->pairs) friction = std::max(friction, pair.friction);
  const auto closed = [&](std::size_t c) { return nodes[c].active && near_->carries[c]; };
  std::size_t middle = nodes.size();  // the median
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    if (!closed(c)) continue;
    double sum = 0;
    for (const ContactNode<dim>& other : nodes)
      if (other.active) sum += other.load * (other.slip - nodes[c].slip).norm();
    if (sum < least) least = sum, middle = c;
  }
  NodalField<dim> traction = NodalField<dim>::Zero(std::ssize(nodes), dim);
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    if (!closed(c)) continue;
    const Vector<dim> slip = nodes[c].slip - nodes[middle].slip;
    traction.row(std::ptrdiff_t(c)) =
        beyond * part * friction * std::abs(nodes[c].traction) * slip.normalized().transpose();
  }
  if (middle < nodes.size())
    traction.row(std::ptrdiff_t(middle)) = -near_->interface.rho * nodes[middle].slip.transpose();
  return traction;
}

/// Where friction is small nearly all slips as without: from there with all of the load, and a part
/// of friction that grows. False where this leads nowhere.
template <int dim>
bool PathMarch<dim>::press_sliding(const Phase<dim>& phase) {
  constexpr double smallest = 1e-3, slowest = 1.1;
  Alone sliding(*this, phase, with_friction(*near_, 0));
  const WornBodyFields& fields = sliding.fields();
  bool touches = false;
  const RampReport ramp = find_equilibrium(sliding.equations, sliding.system, ramp_options(*near_),
                                           sliding.values, counters_, [&](std::span<double> y) {
                                             if (!std::exchange(touches, true))
                                               sliding.go_on_from(y);
                                           });
  if (ramp.reached < 1) return false;
  FieldValues<dim> values = sliding.values;
  const auto settles = [&](double part) {
    Alone alone(*this, phase, with_friction(*near_, part));
    alone.values = values;
    alone.remember(sliding.values.vector(fields.memory));
    std::string reason;
    if (!solve(alone, reason, true) || has_left_facets(alone, phase, alone.values, 1)) return false;
    values = alone.values;
    if (part == 1) keep(alone, last_);
    return true;
  };
  const auto nodes = sliding.equations.contact_nodes(sliding.system, sliding.values, {.t = t_});
  const auto begins = [&](double part) {
    values.vector(fields.traction) = slipping(nodes, part);
    return settles(part);
  };
  double part = 1;
  while (!begins(part))
    if (part /= 2; part < smallest) return false;
  for (double factor = 2; part < 1;) {
    const double target = std::min(1.0, factor * part);
    const FieldValues<dim> before = values;
    values.vector(fields.traction) *= target / part;
    if (settles(target)) {
      part = target;
      continue;
    }
    values = before;
    factor = std::sqrt(factor);
    if (factor < slowest) return false;
  }
  return true;
}

template bool PathMarch<2>::press_sliding(const Phase<2>&);
template bool PathMarch<3>::press_sliding(const Phase<3>&);

}  // namespace gnomon
