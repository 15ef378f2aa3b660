// Typical magnitudes of a run, found from the geometry, so that a scene need not give them.
#pragma once

#include <cmath>
#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// How deep the nodes of unloaded bodies lie in a counter-body that has made this part of its given
/// approach at t = 0 [length].
template <int dim>
double overlap_at_rest(const std::vector<ContactPatch<dim>>& nodes, const CounterBody<dim>& other,
                       double part = 0);

/// What brings the bodies together: a force, or where springs press more, or without one, a
/// displacement.
struct Pressing {
  double force = 0;    ///< the largest of a cycle, at factor one
  double impulse = 0;  ///< its integral over the run [force time]
  double overlap = 0;  ///< by supports that move and by a given approach, at most [length]
  double springs = 0;  ///< where springs alone bring it about: their force, at most
};
template <int dim>
Pressing pressing_of(const AssemblyParts<dim>& parts, double duration);

struct Magnitudes {
  Scales scales;
  double facet = 1;          ///< typical length of a contact facet
  double deepest = 0;        ///< expected wear depth at the end, at most [length]
  double contact_nodes = 0;  ///< expected in contact at the start
  double strain = 0;         ///< mean pressure at the start, by the modulus of the contact
  double slope = 0;          ///< of the worn surface at the end, about, if it is a parabola
  double thinning = 0;       ///< `deepest` by the size of the smallest body that wears
};

/// Typical width of the contact; in space of a square [length].
template <int dim>
double contact_width(const Scales& scales) {
  const double area = scales.force / scales.stress;
  return dim == 2 ? area : std::sqrt(area);
}

/// Of parts whose shape may not be known yet. Throws RecoverableError like wear_by_pressure().
template <int dim>
Magnitudes magnitudes_of(const AssemblyParts<dim>& parts, double duration);

}  // namespace gnomon
