#include "part/part_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

#include "part/histories.hpp"
#include "part/pair_keys.hpp"

namespace gnomon::part {

namespace {

template <int dim>
CycleAxis<dim> read_axis(const Scene& scene, const CounterBody<dim>& body) {
  CycleAxis<dim> axis;
  if (!scene.given("cycle.rotation")) return axis;
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
void check_force(const Scene& scene, const Cycle& cycle, const CounterBody<dim>& other) {
  if (!cycle.force) return;
  if (!other.guides.empty() && other.guides.front().force)
    refuse(scene, "cycle.force", "either cycle.force or counter_body.press.force, got both");
  if (!scene.given("counter_body.press.direction"))
    refuse(scene, "cycle.force",
           other.guides.empty() ? "also counter_body.press.direction"
                                : "one [counter_body.press] beside it, not an array of them");
  if (scene.given("counter_body.press.approach"))
    refuse(scene, "cycle.force", "no counter_body.press.approach beside a force");
}

template <int dim>
std::vector<std::optional<CycleFunction>> read_forces_of_guides(const Scene& scene,
                                                                const CounterBody<dim>& other) {
  std::vector<std::optional<CycleFunction>> forces;
  for (const Guide<dim>& guide : other.guides) {
    const std::string key = guide.key + ".cycle";
    forces.push_back(guide.key.empty() ? std::nullopt : read_cycle_function(scene, key));
    if (!forces.back()) continue;
    if (!guide.force)
      throw InputError(fmt::format("{}: expected also {}.force, or .moment, which it multiplies",
                                   scene.where(key), guide.key));
    if (!may_stick(scene)) refuse(scene, key, "friction.stick = true beside it");
  }
  return forces;
}

}  // namespace

void put_in_meridian(const Scene& scene, const std::string& prefix, Cycle& cycle) {
  for (const char* of : {"x", "y"})
    if (scene.given(prefix + of))
      refuse(scene, prefix + of, "only " + prefix + "z, along the axis, in an axisymmetric scene");
  std::swap(cycle.displacement[1], cycle.displacement[2]);
}

std::optional<double> largest_force(const Cycle& cycle) {
  if (!cycle.force) return {};
  double most = 0;
  for (int k = 0; k < samples; ++k) most = std::max(most, cycle.force->value(double(k) / samples));
  return most;
}

/// Steps by the error are as short by themselves (ModelFacts::longest_step).
template <int dim>
void require_steps_in_turn(const Scene& scene, const Turning<dim>& turning) {
  const char* key = "integrator.step";
  const double step = std::min(scene.real_if(key).value_or(0), scene.real("time.end"));
  if (step > turning.longest_step())
    refuse(scene, key,
           fmt::format("at most {:.3g} s, a sixteenth of a turn of the counter-body, which changes "
                       "its place as it turns (or [cycle] with `rotation`: the mean over turns), "
                       "got {:g} s",
                       turning.longest_step(), step));
}

template <int dim>
std::optional<CyclicMotion<dim>> read_part_cycle(const Scene& scene,
                                                 const CounterBody<dim>& other) {
  std::optional<Cycle> cycle = read_cycle(scene);
  if (!cycle) {
    if (other.turning) require_steps_in_turn(scene, *other.turning);
    for (const Guide<dim>& guide : other.guides)
      if (const std::string key = guide.key + ".cycle"; !guide.key.empty() && scene.given(key))
        refuse(scene, key, "also cycle.period");
    return {};
  }
  if (other.turning)
    refuse(scene, "counter_body.motion.rotation",
           "cycle.rotation instead in a scene with a cycle, because the shape changes its place "
           "when it turns");
  if (dim == 2 && section_of(scene) == Section::meridian) put_in_meridian(scene, "cycle.", *cycle);
  check_force(scene, *cycle, other);
  const CycleAxis<dim> axis = read_axis(scene, other);
  if (axis.turns_shape && std::ranges::any_of(other.guides, &Guide<dim>::turns))
    refuse(scene, "cycle.rotation",
           "none beside a moment in [[counter_body.press]]: the shape turns");
  return CyclicMotion<dim>{std::move(*cycle), axis, read_forces_of_guides(scene, other)};
}

template <int dim>
std::vector<CounterBody<dim>> instants(const CounterBody<dim>& rest,
                                       const std::optional<CyclicMotion<dim>>& cycle) {
  if (!cycle) return {rest};
  std::vector<CounterBody<dim>> result;
  for (int k = 0; k < samples; ++k)
    result.push_back(counter_body_at<dim>(rest, cycle->cycle, cycle->axis, (k + 0.5) / samples));
  return result;
}

template std::optional<CyclicMotion<2>> read_part_cycle(const Scene&, const CounterBody<2>&);
template std::optional<CyclicMotion<3>> read_part_cycle(const Scene&, const CounterBody<3>&);
template std::vector<CounterBody<2>> instants(const CounterBody<2>&,
                                              const std::optional<CyclicMotion<2>>&);
template std::vector<CounterBody<3>> instants(const CounterBody<3>&,
                                              const std::optional<CyclicMotion<3>>&);

}  // namespace gnomon::part
