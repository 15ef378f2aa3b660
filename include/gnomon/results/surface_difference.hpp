// How far two worn surfaces are apart, on the same mesh or on different ones.
#pragma once

#include <gnomon/model/model.hpp>
#include <vector>

namespace gnomon {

/// At each node of the first surface.
struct SurfaceDifference {
  std::vector<double> distance;  ///< of the worn surfaces along the initial normal [length]
  std::vector<double> pressure;  ///< the own one minus that of the other surface [stress]
};

/// The other surface is interpolated: linear through the nearest nodes of its initial surface, so
/// that a node at the same place has its values.
SurfaceDifference surface_difference(const ContactSurface& surface, const ContactSurface& other);

/// Euclidean norm of the distances along the normal, times the root of the ratio of the numbers of
/// nodes, as over the nodes of the reference [length].
double distance_error(const ContactSurface& surface, const ContactSurface& reference);

/// The paper's error (sec. 4.1): Euclidean norm of the differences of worn (undeformed)
/// contact-node positions [length]. On different meshes distance_error().
double shape_error(const ContactSurface& surface, const ContactSurface& reference);

/// Largest difference of the nodal contact pressures [stress]; on another mesh the reference is
/// interpolated.
double pressure_error(const ContactSurface& surface, const ContactSurface& reference);

}  // namespace gnomon
