// How fast the bodies of steady rolling slip, about, before a run.
#include <algorithm>
#include <cmath>

#include "part/rolling_scene.hpp"

namespace gnomon::part {

template <int dim>
bool slips_as_given(const AssemblyParts<dim>& parts) {
  const Rolling<dim>& rolling = *parts.interface.rolling;
  const bool is_given = !rolling.creepage.isZero(0) || !rolling.spin.isZero(0);
  return is_given && !rolling.creeps() &&
         std::ranges::none_of(parts.interface.partner.guides, &Guide<dim>::creeps);
}

namespace {

/// Of what friction can hold, the part that forces along the surface take up, mean over the run; 0
/// where none is given.
template <int dim>
double part_of_friction(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  const double duration = expected.scales.duration;
  Vector<dim> along = Vector<dim>::Zero();
  for (const Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.creeps() && guide.force)
      along += *guide.force * guide.factors.integral(duration) / duration * guide.along;
  for (int i = 0; i < dim; ++i) along[i] += parts.interface.rolling->force[i].value_or(0);
  const Pressing press = pressing_of(parts, duration);
  const double across = press.force > 0 ? press.impulse / duration : expected.scales.force;
  return across > 0 ? std::min(1.0, along.norm() / (parts.interface.friction * across)) : 0;
}

/// The mean slip, by pressures, that makes those forces, divided by the velocity: of Carter's
/// contact, in space of J. K. Vermeulen's and K. L. Johnson's, by the mean strain of the contact.
template <int dim>
double slip_by_forces(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  constexpr double least = 0.3;  // unlike bodies slip where they roll freely
  constexpr double limit = dim == 2 ? 8 / M_PI : 3;
  const double part = std::max(least, part_of_friction(parts, expected)),
               creepage = 1 - std::pow(1 - part, 1.0 / dim);
  return limit * parts.interface.friction * expected.strain * part * creepage;
}

}  // namespace

template <int dim>
double speed_of_rolling(const AssemblyParts<dim>& parts, const Magnitudes& expected) {
  const Rolling<dim>& rolling = *parts.interface.rolling;
  const double spin = rolling.spin.norm() / std::sqrt(2);  // of a skew tensor
  const double half = contact_width<dim>(expected.scales) / 2,
               given = rolling.creepage.norm() + half * spin,
               found = slips_as_given(parts) ? 0 : slip_by_forces(parts, expected);
  return rolling.velocity.norm() * (given + found);
}

template <int dim>
void scale_creepages(const Magnitudes& expected, AssemblyParts<dim>& parts) {
  const double half = contact_width<dim>(expected.scales) / 2;
  for (Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.creeps()) guide.creep = half;
  parts.interface.rolling->creepage_scale = expected.scales.displacement / half;
  parts.interface.rolling->arm = half;
}

template bool slips_as_given(const AssemblyParts<2>&);
template bool slips_as_given(const AssemblyParts<3>&);
template double speed_of_rolling(const AssemblyParts<2>&, const Magnitudes&);
template double speed_of_rolling(const AssemblyParts<3>&, const Magnitudes&);
template void scale_creepages(const Magnitudes&, AssemblyParts<2>&);
template void scale_creepages(const Magnitudes&, AssemblyParts<3>&);

}  // namespace gnomon::part
