// Typical magnitudes of a run, found from the geometry, so that a scene need not give them.
#pragma once

#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

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

struct Magnitudes {
  Scales scales;
  double facet = 1;          ///< typical length of a contact facet
  double deepest = 0;        ///< expected wear depth at the end, at most [length]
  double contact_nodes = 0;  ///< expected in contact at the start
};

/// `force`: what presses the bodies together; zero where an approach or a displacement does, by
/// `overlap` [length]. The contact surface, the counter-body and its motion are given.
template <int dim>
Magnitudes find_magnitudes(const Scene& scene, double force, double overlap, double impulse,
                           const WornBody<dim>& body);

}  // namespace gnomon::part
