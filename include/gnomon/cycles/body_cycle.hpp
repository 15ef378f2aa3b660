// The place of a body over a cycle (docs/two_bodies.md, "Cycles").
#pragma once

#include <gnomon/cycles/cycle.hpp>
#include <gnomon/shapes/body_place.hpp>

namespace gnomon {

/// A body that is displaced, and turned about an axis that is displaced with it, by the functions
/// of a cycle. Of a body of revolution: turned about r = 0, which moves out of the section.
template <int dim>
struct BodyCycle {
  Cycle cycle{};            ///< displacement and rotation alone
  CycleAxis<dim> axis{};    ///< its centre: where it is before it is displaced
  RigidMotion<dim> motion;  ///< steady, of its material: beside that of the cycle
  std::string name{};       ///< of the body

  /// At a position of the cycle. The derivative at a breakpoint is that of what follows.
  BodyPlace<dim> at(double tau) const;
  bool moves() const;
};

}  // namespace gnomon
