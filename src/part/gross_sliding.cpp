#include "part/gross_sliding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <limits>

namespace gnomon::part {

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
  constexpr int samples = 2048;
  Steps<dim> steps;
  double most = 0;
  for (int k = 0; k < samples; ++k) {
    steps.push_back(surface_velocity(cycle, rest, (k + 0.5) / samples) *
                    (cycle.cycle.period / samples));
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
  const double nu = parts.bodies.front().material.poisson_ratio;
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
        "would stick (partial slip), which depends on the path within the cycle",
        scene.where("friction.coefficient"), shortest, shear));
}

template void require_gross_sliding(const Scene&, const CyclicMotion<2>&, const AssemblyParts<2>&);
template void require_gross_sliding(const Scene&, const CyclicMotion<3>&, const AssemblyParts<3>&);

}  // namespace gnomon::part
