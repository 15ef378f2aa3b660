// Typical magnitudes of a run, found from the geometry, so that a scene need not give them.
#pragma once

#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// Gaps between the contact surface and the counter-body where they first touch, with their areas.
/// As if each node were on a spring of its own, it tells how much of the surface a load or the wear
/// brings into contact: enough for scales.
class GapProfile {
public:
  /// One entry for each contact node: gap from the first touch [length], area.
  GapProfile(std::vector<double> gaps, std::vector<double> areas);

  /// Of the surface that overlaps when the bodies approach by `depth`.
  double area(double depth) const;
  /// Nodes of that surface.
  double count(double depth) const;
  /// Volume of the overlap.
  double volume(double depth) const;
  /// The depth with that volume of overlap.
  double depth_of(double volume) const;

private:
  std::vector<double> gap_, area_;  // ascending gaps
};

/// What brings the bodies together: a force, or without one a displacement.
struct Pressing {
  double force = 0;    ///< the largest of a cycle, at factor one
  double impulse = 0;  ///< its integral over the run [force time]
  double overlap = 0;  ///< by supports that move and by a given approach, at most [length]
};
template <int dim>
Pressing pressing_of(const AssemblyParts<dim>& parts, double duration);

struct Magnitudes {
  Scales scales;
  double facet = 1;          ///< typical length of a contact facet
  double deepest = 0;        ///< expected wear depth at the end, at most [length]
  double contact_nodes = 0;  ///< expected in contact at the start
};

/// Of parts whose shape may not be known yet. Throws RecoverableError like wear_by_pressure().
template <int dim>
Magnitudes magnitudes_of(const AssemblyParts<dim>& parts, double duration);

}  // namespace gnomon
