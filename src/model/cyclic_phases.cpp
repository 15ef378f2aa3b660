#include <algorithm>
#include <cmath>
#include <gnomon/model/cyclic_phases.hpp>

namespace gnomon {

namespace {

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
    add_motion<dim>(v.dot(direction) < 0 ? -at.weight : at.weight, at.counter_body.motion,
                    at.counter_body.position - phase.counter_body.position, sum);
    const double part = direction.isZero(0) ? at.weight : at.weight * v.norm();
    time += at.weight, path += part;
    force += part * at.force.value_or(0), load += part * at.load;
  }
  motion = {.reference = motion.reference, .normal = motion.normal};
  const double chord = sum.nominal_speed(Vector<dim>::Zero());
  add_motion<dim>(chord > 0 ? path / (chord * time) : 1 / time, sum, Vector<dim>::Zero(), motion);
  if (phase.force) phase.force = force / path;
  phase.load = load / path;
  // Bodies of pairs move as at the fastest instant, as fast as the path is long.
  const double most = sliding_velocity(fastest).norm();
  for (std::size_t b = 0; b < phase.places.size(); ++b) {
    RigidMotion<dim> whole{};
    add_motion<dim>(most > 0 ? path / (time * most) : 1, fastest.places[b].motion,
                    Vector<dim>::Zero(), whole);
    phase.places[b].motion = whole;
  }
}

/// Where a motion reverses, its direction would be that of a rounding error. `of`: the motion of a
/// phase.
template <int dim, class Of>
void bring_to_rest(std::vector<Phase<dim>>& phases, const Of& of) {
  constexpr double rounding = 1e-9;
  double velocity = 0, spin = 0, across = 0, across_by_x = 0;
  for (Phase<dim>& phase : phases) {
    const RigidMotion<dim>& motion = of(phase);
    velocity = std::max(velocity, motion.velocity.norm());
    spin = std::max(spin, motion.spin.norm());
    across = std::max(across, std::abs(motion.across));
    across_by_x = std::max(across_by_x, motion.across_by_x.norm());
  }
  for (Phase<dim>& phase : phases) {
    RigidMotion<dim>& motion = of(phase);
    if (motion.velocity.norm() <= rounding * velocity) motion.velocity.setZero();
    if (motion.spin.norm() <= rounding * spin) motion.spin.setZero();
    if (std::abs(motion.across) <= rounding * across) motion.across = 0;
    if (motion.across_by_x.norm() <= rounding * across_by_x) motion.across_by_x.setZero();
  }
}

/// How the pair slides at its point, in space.
template <int dim>
RigidMotion<dim> sliding_of(const CyclicMotion<dim>& motion,
                            const std::vector<BodyPlace<dim>>& places) {
  const BodyPlace<dim>& own = places[static_cast<std::size_t>(motion.sliding[0])];
  RigidMotion<dim> result =
      relative_motion(own.motion, places[static_cast<std::size_t>(motion.sliding[1])].motion);
  result.reference = own.of(motion.point);
  result.normal = own.turn * motion.normal;
  return result;
}

/// The forces along the guides in a phase; the counter-body comes near along their sum.
template <int dim>
void apply_forces(const CyclicMotion<dim>& motion, Phase<dim>& phase) {
  Vector<dim> sum = Vector<dim>::Zero();
  bool changes = false;
  for (std::size_t k = 0; k < motion.forces.size(); ++k) {
    Guide<dim>& guide = phase.counter_body.guides[k];
    std::optional<double>& along = k == 0 ? phase.force : guide.force;
    if (motion.forces[k] && along) {
      *along *= motion.forces[k]->value(phase.position);
      changes = true;
    }
    sum += along.value_or(0) * guide.along;
  }
  if (changes && phase.force) phase.counter_body.come_along(sum);
}

}  // namespace

template <int dim>
Phase<dim> phase_at(const CyclePoint& point, const CyclicMotion<dim>& motion,
                    const CounterBody<dim>& rest, std::optional<double> force) {
  const double tau = point.position;
  Phase<dim> phase{.position = tau,
                   .weight = point.weight,
                   .counter_body = counter_body_at<dim>(rest, motion.cycle, motion.axis, tau),
                   .force = force,
                   .places = {}};
  phase.counter_body.motion.reference += rest.position - phase.counter_body.position;
  for (const BodyCycle<dim>& body : motion.bodies) phase.places.push_back(body.at(tau));
  if (!phase.places.empty()) phase.counter_body.motion = sliding_of(motion, phase.places);
  if (motion.cycle.rotation) phase.angle = phase.angle_before = motion.cycle.rotation->value(tau);
  if (motion.cycle.load) phase.load = motion.cycle.load->value(tau);
  if (motion.cycle.force) phase.force = motion.cycle.force->value(tau);
  apply_forces(motion, phase);
  return phase;
}

template <int dim>
std::vector<Phase<dim>> phases_of(const CyclicContact<dim>& cycle, const CounterBody<dim>& rest,
                                  std::optional<double> force, const PhaseSet& set) {
  std::vector<Phase<dim>> phases = phases_of(
      cycle.quadrature, set,
      [&](const CyclePoint& point) { return phase_at(point, cycle.motion, rest, force); },
      stand_for<dim>);
  if (set.kind == PhaseSet::Kind::fine) return phases;
  bring_to_rest<dim>(
      phases, [](Phase<dim> & phase) -> auto& { return phase.counter_body.motion; });
  for (std::size_t b = 0; b < cycle.motion.bodies.size(); ++b)
    bring_to_rest<dim>(
        phases, [b](Phase<dim> & phase) -> auto& { return phase.places[b].motion; });
  return phases;
}

template <int dim>
std::vector<Phase<dim>> path_phases(const std::vector<CyclePoint>& ends,
                                    const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                                    std::optional<double> force) {
  std::vector<Phase<dim>> phases;
  for (std::size_t p = 0; p < ends.size(); ++p) {
    const double after = ends[(p + 1) % ends.size()].weight;
    phases.push_back(
        phase_at({ends[p].position, (ends[p].weight + after) / 2}, motion, rest, force));
    phases.back().interval = ends[p].weight;
  }
  for (std::size_t p = 0; p < phases.size(); ++p)
    phases[p].angle_before = phases[p > 0 ? p - 1 : phases.size() - 1].angle;
  return phases;
}

template std::vector<Phase<2>> path_phases(const std::vector<CyclePoint>&, const CyclicMotion<2>&,
                                           const CounterBody<2>&, std::optional<double>);
template std::vector<Phase<3>> path_phases(const std::vector<CyclePoint>&, const CyclicMotion<3>&,
                                           const CounterBody<3>&, std::optional<double>);

template <int dim>
Vector<dim> carried_by(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                       const Phase<dim>& phase, const Vector<dim>& X) {
  if (!phase.places.empty()) {
    const auto place = [&](std::size_t side) {
      return phase.places[static_cast<std::size_t>(motion.sliding[side])];
    };
    return place(0).turn.transpose() * (place(1).of(X) - place(0).of(X));
  }
  Vector<dim> carried = phase.counter_body.position - rest.position;
  if (!motion.cycle.rotation) return carried;
  // The surface slides by along a node that stays where it is: by the arc, not by its chord.
  const Vector<dim> arm = X - rest.position - motion.axis.centre;
  return carried + motion.cycle.rotation->value(phase.position) * (motion.axis.spin * arm);
}

template <int dim>
Vector<dim> carried_by(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                       const Phase<dim>& phase) {
  const Vector<dim> touched = rest.position + rest.motion.reference;
  return carried_by(motion, rest, phase, phase.places.empty() ? touched : motion.point);
}

template Vector<2> carried_by(const CyclicMotion<2>&, const CounterBody<2>&, const Phase<2>&);
template Vector<3> carried_by(const CyclicMotion<3>&, const CounterBody<3>&, const Phase<3>&);
template Vector<2> carried_by(const CyclicMotion<2>&, const CounterBody<2>&, const Phase<2>&,
                              const Vector<2>&);
template Vector<3> carried_by(const CyclicMotion<3>&, const CounterBody<3>&, const Phase<3>&,
                              const Vector<3>&);
template Phase<2> phase_at(const CyclePoint&, const CyclicMotion<2>&, const CounterBody<2>&,
                           std::optional<double>);
template Phase<3> phase_at(const CyclePoint&, const CyclicMotion<3>&, const CounterBody<3>&,
                           std::optional<double>);
template std::vector<Phase<2>> phases_of(const CyclicContact<2>&, const CounterBody<2>&,
                                         std::optional<double>, const PhaseSet&);
template std::vector<Phase<3>> phases_of(const CyclicContact<3>&, const CounterBody<3>&,
                                         std::optional<double>, const PhaseSet&);

}  // namespace gnomon
