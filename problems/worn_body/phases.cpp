#include "phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/counter_body_scene.hpp>
#include <gnomon/laws/cycle_scene.hpp>

#include "histories.hpp"
#include "model/phase_error.hpp"

namespace gnomon::part {

namespace {

constexpr int samples = 64;  // positions at which a cycle is looked at before its phases are known

template <int dim>
void check_displacement(const Scene& scene, Cycle& cycle) {
  if (dim == 3 || section_of(scene) == Section::plane) return;
  for (const char* key : {"cycle.x", "cycle.y"})
    if (given(scene, key))
      throw InputError(scene.where(key) +
                       ": expected only cycle.z, along the axis, in an axisymmetric scene");
  std::swap(cycle.displacement[1], cycle.displacement[2]);  // coordinates (r, z)
}

template <int dim>
CycleAxis<dim> read_axis(const Scene& scene, const CounterBody<dim>& body) {
  CycleAxis<dim> axis;
  if (!given(scene, "cycle.rotation")) return axis;
  if (dim == 2 && section_of(scene) == Section::meridian) {
    axis.meridian = true;
    return axis;
  }
  axis.centre = rotation_center<dim>(scene, "cycle.rotation");
  axis.spin = rotation_spin<dim>(scene, 1, "cycle.rotation");
  axis.turns_shape = !turns_into_itself(body.shape, axis.spin, axis.centre);
  return axis;
}

/// The force of a free counter-body keeps it where it is.
template <int dim>
void take_force(const Scene& scene, const Cycle& cycle, WornBody<dim>& body) {
  if (!cycle.force) return;
  if (body.counter_force)
    throw InputError(scene.where("cycle.force") +
                     ": expected either cycle.force or counter_body.press.force, got both");
  if (!given(scene, "counter_body.press.direction"))
    throw InputError(scene.where("cycle.force") + ": expected also counter_body.press.direction");
  if (given(scene, "counter_body.press.approach"))
    throw InputError(scene.where("cycle.force") +
                     ": expected no counter_body.press.approach beside a force");
  double most = 0;
  for (int k = 0; k < samples; ++k) most = std::max(most, cycle.force->value(double(k) / samples));
  body.counter_force = most;
}

template <int dim>
Phase<dim> phase_at(const Scene& scene, const CyclePoint& point, const PartCycle<dim>& part,
                    const WornBody<dim>& body) {
  const CounterBody<dim>& rest = body.contact.counter_body;
  const double tau = point.position;
  Phase<dim> phase{.position = tau,
                   .weight = point.weight,
                   .counter_body = counter_body_at<dim>(rest, part.cycle, part.axis, tau),
                   .force = body.counter_force};
  phase.counter_body.motion.reference += rest.position - phase.counter_body.position;
  if (part.cycle.load) phase.load = part.cycle.load->value(tau);
  if (!part.cycle.force) return phase;
  phase.force = part.cycle.force->value(tau);
  if (!(*phase.force >= 1e-6 * *body.counter_force))
    throw InputError(fmt::format(
        "{}: expected a force above zero (1e-6 of the largest or more) in every phase, got {:g} at "
        "tau = {:g}: without a force the place of the counter-body is not determined",
        scene.where("cycle.force"), *phase.force, tau));
  return phase;
}

/// The velocity of its surface at the reference of its motion, the component out of the plane last
/// [length / time].
template <int dim>
Eigen::Matrix<double, dim + 1, 1> velocity_at(const PartCycle<dim>& part,
                                              const CounterBody<dim>& rest, double tau) {
  const CounterBody<dim> body = counter_body_at<dim>(rest, part.cycle, part.axis, tau);
  const Vector<dim> place = rest.motion.reference + rest.position - body.position;
  Eigen::Matrix<double, dim + 1, 1> v;
  v << body.motion.template at<double>(place), body.motion.template across_at<double>(place);
  return v;
}

/// Where the speed at the reference is zero and changes its sign, |v| has a kink.
template <int dim>
std::vector<double> reversals(const PartCycle<dim>& part, const CounterBody<dim>& rest) {
  const auto velocity = [&](double tau) { return velocity_at(part, rest, tau); };
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

}  // namespace

template <int dim>
std::optional<PartCycle<dim>> read_part_cycle(const Scene& scene, WornBody<dim>& body) {
  std::optional<Cycle> cycle = read_cycle(scene);
  if (!cycle) return {};
  if (body.contact.counter_body.turning)
    throw InputError(scene.where("counter_body.motion.rotation") +
                     ": expected cycle.rotation instead in a scene with a cycle, because the shape "
                     "changes its place when it turns");
  check_displacement<dim>(scene, *cycle);
  take_force(scene, *cycle, body);
  const CycleAxis<dim> axis = read_axis(scene, body.contact.counter_body);
  return PartCycle<dim>{std::move(*cycle), axis};
}

template <int dim>
std::vector<CounterBody<dim>> instants(const WornBody<dim>& body,
                                       const std::optional<PartCycle<dim>>& cycle) {
  const CounterBody<dim>& rest = body.contact.counter_body;
  if (!cycle) return {rest};
  std::vector<CounterBody<dim>> result;
  for (int k = 0; k < samples; ++k)
    result.push_back(counter_body_at<dim>(rest, cycle->cycle, cycle->axis, (k + 0.5) / samples));
  return result;
}

namespace {

/// Of the mean over the cycle: corners of the functions, and reversals.
template <int dim>
std::vector<double> kinks_of(const PartCycle<dim>& part, const WornBody<dim>& body) {
  return merged_kinks(part.cycle.kinks(), reversals(part, body.contact.counter_body));
}

}  // namespace

template <int dim>
void make_phases(const Scene& scene, const PartCycle<dim>& part, WornBody<dim>& body) {
  body.refined_cycle = [scene, part, kinks = kinks_of(part, body)](const WornBody<dim>& of,
                                                                   int refinement) {
    std::vector<Phase<dim>> phases;
    for (const CyclePoint& point : read_cycle_points(scene, kinks, refinement))
      phases.push_back(phase_at(scene, point, part, of));
    return phases;
  };
  body.cycle = body.refined_cycle(body, 1);
}

template <int dim>
std::shared_ptr<WornBody<dim>> with_chosen_phases(
    const Scene& scene, const std::function<std::shared_ptr<WornBody<dim>>(long phases)>& with) {
  constexpr long fewest = 4, most = 256;
  const double tolerance = phase_tolerance(scene);
  auto body = with(fewest);
  PhaseError chosen{0, fewest, 0};
  std::string why;
  try {
    chosen = choose_phases<dim>(body, tolerance, most);
    why = std::isfinite(chosen.error)
              ? fmt::format("the mean over them has an error of about {:.1g}", chosen.error)
              : fmt::format(
                    "the mean over fewer has an error of more than {:g}, and more are not "
                    "tried",
                    tolerance);
  } catch (const SolutionError& error) {
    why = std::string("more cannot be compared: ") + error.what();
  }
  if (chosen.phases != fewest) body = with(chosen.phases);
  body->remarks.push_back(
      fmt::format("cycle.phases = \"auto\": {} phases, {}", chosen.phases, why));
  return body;
}

template <int dim>
void require_gross_sliding(const Scene& scene, const PartCycle<dim>& cycle,
                           const WornBody<dim>& body) {
  const double friction = scene.real("friction.coefficient"), nu = scene.real("body.poisson_ratio");
  const CounterBody<dim>& rest = body.contact.counter_body;
  const auto velocity = [&](double tau) { return velocity_at(cycle, rest, tau); };
  int reversals = 0;
  double path = 0;
  for (int k = 0; k < samples; ++k) {
    const auto v = velocity((k + 0.5) / samples);
    if (v.dot(velocity(k + 1 == samples ? 0.5 / samples : (k + 1.5) / samples)) < 0) ++reversals;
    path += v.norm() * cycle.cycle.period / samples;
  }
  if (reversals == 0) return;
  const double amplitude = path / reversals / 2;
  const double shear = friction * (2 - nu) / (2 * (1 - nu)) * body.scales.displacement;
  if (amplitude < shear)
    throw InputError(fmt::format(
        "{}: expected bodies that slide over the whole contact, but the amplitude of the motion, "
        "{:.2g} mm, is less than the elastic shear of the contact, about {:.2g} mm: a part of it "
        "would stick (partial slip), which depends on the path within the cycle",
        scene.where("friction.coefficient"), amplitude, shear));
}

template std::optional<PartCycle<2>> read_part_cycle(const Scene&, WornBody<2>&);
template std::optional<PartCycle<3>> read_part_cycle(const Scene&, WornBody<3>&);
template std::vector<CounterBody<2>> instants(const WornBody<2>&,
                                              const std::optional<PartCycle<2>>&);
template std::vector<CounterBody<3>> instants(const WornBody<3>&,
                                              const std::optional<PartCycle<3>>&);
template void make_phases(const Scene&, const PartCycle<2>&, WornBody<2>&);
template void make_phases(const Scene&, const PartCycle<3>&, WornBody<3>&);
template std::shared_ptr<WornBody<2>> with_chosen_phases(
    const Scene&, const std::function<std::shared_ptr<WornBody<2>>(long)>&);
template std::shared_ptr<WornBody<3>> with_chosen_phases(
    const Scene&, const std::function<std::shared_ptr<WornBody<3>>(long)>&);
template void require_gross_sliding(const Scene&, const PartCycle<2>&, const WornBody<2>&);
template void require_gross_sliding(const Scene&, const PartCycle<3>&, const WornBody<3>&);

}  // namespace gnomon::part
