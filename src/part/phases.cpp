#include "part/phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <limits>
#include <utility>

#include "model/phase_error.hpp"

namespace gnomon::part {

template <int dim>
std::vector<double> reversals(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest) {
  const auto velocity = [&](double tau) { return surface_velocity(motion, rest, tau); };
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

namespace {

/// Of the mean over the cycle: corners of the functions, and reversals.
template <int dim>
std::vector<double> kinks_of(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest) {
  std::vector<double> kinks = motion.cycle.kinks();
  for (const BodyCycle<dim>& body : motion.bodies)
    kinks = merged_kinks(std::move(kinks), body.cycle.kinks());
  return merged_kinks(std::move(kinks), reversals(motion, rest));
}

/// Under a force a lift of the counter-body only shifts the w that it finds, which its velocity
/// does not know. Empty where it is small.
template <int dim>
std::string remark_on_lift(const std::vector<Phase<dim>>& phases) {
  const auto lift = [](const Phase<dim>& phase) {
    const RigidMotion<dim>& motion = phase.counter_body.motion;
    return std::abs(motion.normal.dot(motion.at(motion.reference)));
  };
  const auto sliding = [](const Phase<dim>& phase) { return sliding_velocity(phase).norm(); };
  const double lifted = mean_over(phases, lift), slid = mean_over(phases, sliding);
  if (!phases.front().force || !(lifted > slid)) return {};
  return fmt::format(
      "cycle: the counter-body is lifted {:.2g} times as fast as it slides; under a force this "
      "only shifts its place, but counts as sliding on inclined sides of the contact",
      lifted / slid);
}

}  // namespace

template <int dim>
void require_forces(const Scene& scene, const std::vector<Phase<dim>>& phases,
                    const std::string& press, std::optional<double> largest) {
  constexpr double least = 1e-6;
  for (const Phase<dim>& phase : phases)
    if (largest && !(phase.force.value_or(0) >= least * *largest))
      throw InputError(fmt::format(
          "{}: expected a force above zero (1e-6 of the largest or more) in every phase, got {:g} "
          "at tau = {:g}: without a force the place of the counter-body is not determined",
          scene.where(scene.given("cycle.force") ? "cycle.force" : press + ".cycle"), *phase.force,
          phase.position));
}

template <int dim>
Eigen::Matrix<double, dim + 1, 1> surface_velocity(const CyclicMotion<dim>& motion,
                                                   const CounterBody<dim>& rest, double tau) {
  return sliding_velocity(phase_at<dim>({.position = tau}, motion, rest, {}));
}

template <int dim>
double mean_speed(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest) {
  double sum = 0;
  for (const CyclePoint& point : CycleQuadrature(1, kinks_of(motion, rest)).fine_points())
    sum += point.weight * surface_velocity(motion, rest, point.position).norm();
  return sum;
}

template <int dim>
ReadPhases<dim> read_phases(const Scene& scene, const CyclicMotion<dim>& motion,
                            const CounterBody<dim>& rest, std::optional<double> force,
                            const std::vector<double>& others) {
  constexpr double beside = 1e-3;  // a part of its own would waste a phase
  std::vector<double> kinks = kinks_of(motion, rest);
  for (const double other : others)
    if (std::ranges::none_of(
            kinks, [&](double kink) { return std::abs(std::remainder(kink - other, 1)) < beside; }))
      kinks = merged_kinks(std::move(kinks), {other});
  const CyclicContact<dim> contact{motion, read_cycle_quadrature(scene, kinks)};
  ReadPhases<dim> result{contact, phases_of(contact, rest, force), motion.cycle.remarks()};
  for (const BodyCycle<dim>& body : motion.bodies)
    for (const std::string& remark : body.cycle.remarks()) {
      std::string text = fmt::format("[[motion]] of \"{}\": {}", body.name, remark);
      if (std::ranges::count(result.remarks, text) == 0)  // bonded bodies have the same
        result.remarks.push_back(std::move(text));
    }
  if (motion.cycle.force) require_forces(scene, result.phases, "", force);
  const double error =
      error_of_motion(result.phases, phases_of(contact, rest, force, {PhaseSet::Kind::fine}));
  for (const std::string& remark :
       {remark_on_lift(result.phases),
        remark_on_motion(error, phase_tolerance(scene), static_cast<long>(result.phases.size()),
                         contact.quadrature.parts())})
    if (!remark.empty()) result.remarks.push_back(remark);
  return result;
}

namespace {

/// With the fewest phases in some of which something presses the bodies, and how many.
template <int dim>
std::pair<AssemblyParts<dim>, long> with_pressing_phases(
    const std::function<AssemblyParts<dim>(long phases)>& with) {
  for (long count = fewest_chosen_phases; count < most_chosen_phases; count *= 2) try {
      return {with(count), count};
    } catch (const NothingPresses&) {
      continue;
    }
  return {with(most_chosen_phases), most_chosen_phases};
}

}  // namespace

template <int dim>
AssemblyParts<dim> with_chosen_phases(const Scene& scene,
                                      const std::function<AssemblyParts<dim>(long phases)>& with) {
  const double tolerance = phase_tolerance(scene);
  auto [parts, fewest] = with_pressing_phases<dim>(with);
  std::string remark;
  try {
    const ChosenPhases chosen =
        choose_phases<dim>(std::make_shared<const Assembly<dim>>(parts), tolerance);
    remark = remark_on_choice(chosen, tolerance);
    if (chosen.count != fewest) parts = with(chosen.count);
  } catch (const SolutionError& error) {
    remark = fmt::format("cycle.phases = \"auto\": {} phases, more cannot be compared: {}", fewest,
                         error.what());
  }
  parts.remarks.push_back(remark);
  return parts;
}

template std::vector<double> reversals(const CyclicMotion<2>&, const CounterBody<2>&);
template ReadPhases<2> read_phases(const Scene&, const CyclicMotion<2>&, const CounterBody<2>&,
                                   std::optional<double>, const std::vector<double>&);
template std::vector<double> reversals(const CyclicMotion<3>&, const CounterBody<3>&);
template ReadPhases<3> read_phases(const Scene&, const CyclicMotion<3>&, const CounterBody<3>&,
                                   std::optional<double>, const std::vector<double>&);
template AssemblyParts<2> with_chosen_phases(const Scene&,
                                             const std::function<AssemblyParts<2>(long)>&);
template AssemblyParts<3> with_chosen_phases(const Scene&,
                                             const std::function<AssemblyParts<3>(long)>&);
template Eigen::Matrix<double, 3, 1> surface_velocity(const CyclicMotion<2>&, const CounterBody<2>&,
                                                      double);
template Eigen::Matrix<double, 4, 1> surface_velocity(const CyclicMotion<3>&, const CounterBody<3>&,
                                                      double);
template void require_forces(const Scene&, const std::vector<Phase<2>>&, const std::string&,
                             std::optional<double>);
template void require_forces(const Scene&, const std::vector<Phase<3>>&, const std::string&,
                             std::optional<double>);
template double mean_speed(const CyclicMotion<2>&, const CounterBody<2>&);
template double mean_speed(const CyclicMotion<3>&, const CounterBody<3>&);

namespace {

/// What the counter-body slides from one reversal to the next.
struct Stroke {
  double path = 0;       ///< [length]
  double amplitude = 0;  ///< half of how far it comes from where it began [length]
};

template <int dim>
using Steps = std::vector<Eigen::Matrix<double, dim + 1, 1>>;

/// Displacements in equal parts of the cycle in which the surface moves, in their order.
template <int dim>
Steps<dim> moving_steps(const CyclicMotion<dim>& cycle, const CounterBody<dim>& rest) {
  constexpr int many = 2048;
  Steps<dim> steps;
  double most = 0;
  for (int k = 0; k < many; ++k) {
    steps.push_back(surface_velocity(cycle, rest, (k + 0.5) / many) * (cycle.cycle.period / many));
    most = std::max(most, steps.back().norm());
  }
  std::erase_if(steps, [most](const auto& step) { return step.norm() <= 1e-9 * most; });
  return steps;
}

/// A motion that never reverses is one stroke, of any amplitude where it does not come back.
template <int dim>
std::vector<Stroke> strokes_of(Steps<dim> steps) {
  const auto reverses = [](const auto& before, const auto& step) { return before.dot(step) < 0; };
  for (std::size_t k = 0; k + 1 < steps.size(); ++k)
    if (reverses(steps[k], steps[k + 1])) {
      std::rotate(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k) + 1, steps.end());
      break;
    }
  std::vector<Stroke> strokes;
  Eigen::Matrix<double, dim + 1, 1> from_begin = Eigen::Matrix<double, dim + 1, 1>::Zero();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (k == 0 || reverses(steps[k - 1], steps[k])) {
      strokes.emplace_back();
      from_begin.setZero();
    }
    from_begin += steps[k];
    strokes.back().path += steps[k].norm();
    strokes.back().amplitude = std::max(strokes.back().amplitude, from_begin.norm() / 2);
  }
  constexpr double rounding = 1e-6;
  if (strokes.size() == 1 && from_begin.norm() > rounding * strokes.front().path)
    strokes.front().amplitude = std::numeric_limits<double>::infinity();
  return strokes;
}

}  // namespace

template <int dim>
void require_gross_sliding(const Scene& scene, const CyclicMotion<dim>& cycle,
                           const AssemblyParts<dim>& parts) {
  constexpr double negligible = 0.05;  // noise of a measured motion
  double nu = 0;  // the largest: which of bonded bodies shears is not known here
  for (const Body& body : parts.bodies) nu = std::max(nu, body.material.poisson_ratio);
  const double shear =
      parts.interface.friction * (2 - nu) / (2 * (1 - nu)) * parts.scales.displacement;
  double path = 0, short_path = 0, shortest = std::numeric_limits<double>::infinity();
  for (const Stroke& stroke : strokes_of<dim>(moving_steps(cycle, parts.interface.partner))) {
    path += stroke.path;
    if (stroke.amplitude < shear) short_path += stroke.path;
    shortest = std::min(shortest, stroke.amplitude);
  }
  if (short_path > negligible * path)
    throw InputError(fmt::format(
        "{}: expected bodies that slide over the whole contact, but the amplitude of the motion, "
        "{:.2g} mm, is less than the elastic shear of the contact, about {:.2g} mm: a part of it "
        "would stick (partial slip), which friction.stick = true follows",
        scene.where("friction.coefficient"), shortest, shear));
}

template void require_gross_sliding(const Scene&, const CyclicMotion<2>&, const AssemblyParts<2>&);
template void require_gross_sliding(const Scene&, const CyclicMotion<3>&, const AssemblyParts<3>&);

}  // namespace gnomon::part
