#include "phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>

#include "model/phase_error.hpp"

namespace gnomon::part {

namespace {

template <int dim>
void require_force(const Scene& scene, const Phase<dim>& phase, double largest) {
  if (!(*phase.force >= 1e-6 * largest))
    throw InputError(fmt::format(
        "{}: expected a force above zero (1e-6 of the largest or more) in every phase, got {:g} at "
        "tau = {:g}: without a force the place of the counter-body is not determined",
        scene.where("cycle.force"), *phase.force, phase.position));
}

template <int dim>
Phase<dim> phase_at(const CyclePoint& point, const PartCycle<dim>& part,
                    const WornBody<dim>& body) {
  const CounterBody<dim>& rest = body.contact.counter_body;
  const double tau = point.position;
  Phase<dim> phase{.position = tau,
                   .weight = point.weight,
                   .counter_body = counter_body_at<dim>(rest, part.cycle, part.axis, tau),
                   .force = body.counter_force};
  phase.counter_body.motion.reference += rest.position - phase.counter_body.position;
  if (part.cycle.load) phase.load = part.cycle.load->value(tau);
  if (part.cycle.force) phase.force = part.cycle.force->value(tau);
  return phase;
}

template <int dim>
std::vector<Phase<dim>> phases_at(const std::vector<CyclePoint>& points, const PartCycle<dim>& part,
                                  const WornBody<dim>& body) {
  std::vector<Phase<dim>> phases;
  for (const CyclePoint& point : points) phases.push_back(phase_at(point, part, body));
  return phases;
}

/// Velocity with which the surface slides at the reference, the component out of the plane last.
template <int dim>
Eigen::Matrix<double, dim + 1, 1> sliding_velocity(const Phase<dim>& phase) {
  return phase.counter_body.motion.sliding_velocity(Vector<dim>::Zero());
}

/// Both in the coordinates of the shape, whose origin has moved by `moved` from one to the other.
template <int dim>
void add(double factor, const RigidMotion<dim>& motion, const Vector<dim>& moved,
         RigidMotion<dim>& sum) {
  sum.velocity += factor * motion.at(moved);
  sum.spin += factor * motion.spin;
  sum.across += factor * motion.across_at(moved);
  sum.across_by_x += factor * motion.across_by_x;
}

/// What a phase stands for, from instants of its interval: the whole path at the reference, in the
/// direction of the fastest; and the force and load with which it was made, so that their products
/// with the path are exact. What moves against this direction counts with its path, too; where the
/// path bends, its chord is as fast as the path is long.
template <int dim>
void stand_for(const std::vector<Phase<dim>>& interval, Phase<dim>& phase) {
  RigidMotion<dim>& motion = phase.counter_body.motion;
  const Phase<dim>& fastest = *std::ranges::max_element(
      interval, {}, [&](const Phase<dim>& at) { return sliding_velocity(at).norm(); });
  const Eigen::Matrix<double, dim + 1, 1> direction = sliding_velocity(fastest);
  RigidMotion<dim> sum{.reference = motion.reference, .normal = motion.normal};
  double time = 0, path = 0, force = 0, load = 0;
  for (const Phase<dim>& at : interval) {
    const auto v = sliding_velocity(at);
    add<dim>(v.dot(direction) < 0 ? -at.weight : at.weight, at.counter_body.motion,
             phase.counter_body.position - at.counter_body.position, sum);
    const double part = direction.isZero(0) ? at.weight : at.weight * v.norm();
    time += at.weight, path += part;
    force += part * at.force.value_or(0), load += part * at.load;
  }
  motion = {.reference = motion.reference, .normal = motion.normal};
  const double chord = sum.nominal_speed(Vector<dim>::Zero());
  add<dim>(chord > 0 ? path / (chord * time) : 1 / time, sum, Vector<dim>::Zero(), motion);
  if (phase.force) phase.force = force / path;
  phase.load = load / path;
}

/// Where a motion reverses, its direction would be that of a rounding error.
template <int dim>
void bring_to_rest(std::vector<Phase<dim>>& phases) {
  constexpr double rounding = 1e-9;
  double velocity = 0, spin = 0, across = 0, across_by_x = 0;
  for (const Phase<dim>& phase : phases) {
    const RigidMotion<dim>& motion = phase.counter_body.motion;
    velocity = std::max(velocity, motion.velocity.norm());
    spin = std::max(spin, motion.spin.norm());
    across = std::max(across, std::abs(motion.across));
    across_by_x = std::max(across_by_x, motion.across_by_x.norm());
  }
  for (Phase<dim>& phase : phases) {
    RigidMotion<dim>& motion = phase.counter_body.motion;
    if (motion.velocity.norm() <= rounding * velocity) motion.velocity.setZero();
    if (motion.spin.norm() <= rounding * spin) motion.spin.setZero();
    if (std::abs(motion.across) <= rounding * across) motion.across = 0;
    if (motion.across_by_x.norm() <= rounding * across_by_x) motion.across_by_x.setZero();
  }
}

template <int dim>
std::vector<Phase<dim>> phases_of(const CycleQuadrature& quadrature, const PartCycle<dim>& part,
                                  const WornBody<dim>& body) {
  std::vector<Phase<dim>> phases = phases_at(quadrature.points(), part, body);
  if (quadrature.stands_for_intervals()) {
    const std::vector<std::vector<CyclePoint>> intervals = quadrature.intervals();
    for (std::size_t p = 0; p < phases.size(); ++p)
      stand_for(phases_at(intervals[p], part, body), phases[p]);
  }
  bring_to_rest(phases);
  return phases;
}

/// Where the speed at the reference is zero and changes its sign, |v| has a kink.
template <int dim>
std::vector<double> reversals(const PartCycle<dim>& part, const WornBody<dim>& body) {
  const auto velocity = [&](double tau) { return surface_velocity(part, body, tau); };
  double most = 0;
  for (int k = 0; k < samples; ++k) most = std::max(most, velocity(double(k) / samples).norm());
  std::vector<double> found = sign_changes_in_cycle(
      [&](double tau, std::span<double> values) {
        const auto v = velocity(tau);
        std::copy(v.begin(), v.end(), values.begin());
      },
      dim + 1);
  // The sign of a jump changes, too, but its place is a kink of a function.
  std::erase_if(found, [&](double tau) { return velocity(tau).norm() > 1e-6 * most; });
  return found;
}

/// Of the mean over the cycle: corners of the functions, and reversals.
template <int dim>
std::vector<double> kinks_of(const PartCycle<dim>& part, const WornBody<dim>& body) {
  return merged_kinks(part.cycle.kinks(), reversals(part, body));
}

/// Under a force a lift of the counter-body only shifts the w that it finds, which its velocity
/// does not know.
template <int dim>
void remark_on_lift(WornBody<dim>& body) {
  const auto lift = [](const Phase<dim>& phase) {
    const RigidMotion<dim>& motion = phase.counter_body.motion;
    return std::abs(motion.normal.dot(motion.at(motion.reference)));
  };
  const auto sliding = [](const Phase<dim>& phase) { return sliding_velocity(phase).norm(); };
  const double lifted = mean_over(body.cycle, lift), slid = mean_over(body.cycle, sliding);
  if (body.counter_force && lifted > slid)
    body.remarks.push_back(fmt::format(
        "cycle: the counter-body is lifted {:.2g} times as fast as it slides; under a force this "
        "only shifts its place, but counts as sliding on inclined sides of the contact",
        lifted / slid));
}

}  // namespace

template <int dim>
Eigen::Matrix<double, dim + 1, 1> surface_velocity(const PartCycle<dim>& part,
                                                   const WornBody<dim>& body, double tau) {
  return sliding_velocity(phase_at({.position = tau}, part, body));
}

template <int dim>
double mean_speed(const PartCycle<dim>& part, const WornBody<dim>& body) {
  double sum = 0;
  for (const CyclePoint& point : CycleQuadrature(1, kinks_of(part, body)).fine_points())
    sum += point.weight * surface_velocity(part, body, point.position).norm();
  return sum;
}

template <int dim>
void make_phases(const Scene& scene, const PartCycle<dim>& part, WornBody<dim>& body) {
  const CycleQuadrature quadrature = read_cycle_quadrature(scene, kinks_of(part, body));
  body.phase_set = [part, quadrature](const WornBody<dim>& of, const PhaseSet& set) {
    const CycleQuadrature finer = quadrature.refined(set.times);
    if (set.kind == PhaseSet::Kind::fine) return phases_at(finer.fine_points(), part, of);
    return phases_of(set.kind == PhaseSet::Kind::own ? finer : finer.comparison(), part, of);
  };
  body.cycle = body.phase_set(body, {});
  if (part.cycle.force)
    for (const Phase<dim>& phase : body.cycle) require_force(scene, phase, *body.counter_force);
  for (const std::string& remark : part.cycle.remarks()) body.remarks.push_back(remark);
  remark_on_lift(body);
  const double error = error_of_motion(body.cycle, body.phase_set(body, {PhaseSet::Kind::fine}));
  const std::string remark = remark_on_motion(
      error, phase_tolerance(scene), static_cast<long>(body.cycle.size()), quadrature.parts());
  if (!remark.empty()) body.remarks.push_back(remark);
}

template <int dim>
std::shared_ptr<WornBody<dim>> with_chosen_phases(
    const Scene& scene, const std::function<std::shared_ptr<WornBody<dim>>(long phases)>& with) {
  const double tolerance = phase_tolerance(scene);
  auto body = with(fewest_chosen_phases);
  std::string remark;
  try {
    const ChosenPhases chosen = choose_phases<dim>(body, tolerance);
    remark = remark_on_choice(chosen, tolerance);
    if (chosen.count != fewest_chosen_phases) body = with(chosen.count);
  } catch (const SolutionError& error) {
    remark = fmt::format("cycle.phases = \"auto\": {} phases, more cannot be compared: {}",
                         fewest_chosen_phases, error.what());
  }
  body->remarks.push_back(remark);
  return body;
}

template void make_phases(const Scene&, const PartCycle<2>&, WornBody<2>&);
template void make_phases(const Scene&, const PartCycle<3>&, WornBody<3>&);
template std::shared_ptr<WornBody<2>> with_chosen_phases(
    const Scene&, const std::function<std::shared_ptr<WornBody<2>>(long)>&);
template std::shared_ptr<WornBody<3>> with_chosen_phases(
    const Scene&, const std::function<std::shared_ptr<WornBody<3>>(long)>&);
template Eigen::Matrix<double, 3, 1> surface_velocity(const PartCycle<2>&, const WornBody<2>&,
                                                      double);
template Eigen::Matrix<double, 4, 1> surface_velocity(const PartCycle<3>&, const WornBody<3>&,
                                                      double);
template double mean_speed(const PartCycle<2>&, const WornBody<2>&);
template double mean_speed(const PartCycle<3>&, const WornBody<3>&);

}  // namespace gnomon::part
