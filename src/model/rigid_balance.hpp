// Where bodies that contact holds are in balance as rigid bodies, before a run starts.
#pragma once

#include "model/foundation.hpp"

namespace gnomon {

/// Whether supports that move, or springs whose other ends do, press the bodies on each other: they
/// are where these have moved them, which rigid bodies do not tell. Over a cycle springs alone do
/// not lift them from a cam.
template <int dim>
bool supports_press(const AssemblyParts<dim>& parts);

/// Whether bodies without loads and friction stay in each other, as a ring that was pressed on a
/// shaft.
template <int dim>
bool wedged(const AssemblyParts<dim>& parts);

/// The bodies that supports leave free to move, brought to where pairs touch and then along their
/// loads, on elastic foundations, to where they rest. Elastic bodies start from there with contact
/// that holds them.
template <int dim>
struct RigidBalance {
  NodalField<dim> displacement;  ///< nodes x dim, zero where supports hold it [length]
  NodalField<dim>
      direction;  ///< in which those that nothing but contact holds are pressed; 1 at most
  std::vector<Vector<dim>> x;  ///< where the nodes are then [length]
  bool settled = false;        ///< bodies that may turn or move in several ways have come to rest
  /// Which motion nothing determines: "\"shoe\" can turn about (1, 2)"; empty: none.
  std::string doubt;

  /// Contact is as deep as the scales of the parts say, or less. `places`: of the bodies in a phase
  /// of a cycle; bodies that have one are brought to where they touch only. `times`: when the
  /// bodies, unworn, have to be in balance, too.
  RigidBalance(const AssemblyParts<dim>& parts, const std::vector<BodyPlace<dim>>& places,
               const std::vector<LoadTime>& times = {});
};

}  // namespace gnomon
