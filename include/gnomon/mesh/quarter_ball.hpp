// The lower half of a ball cut by a plane of symmetry: body of the ball-on-flat problem, sec. 4.2.
#pragma once

#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// A core block below the mid-plane, surrounded at the bottom and at three sides by layers that
/// follow the sphere. The elements of the contact zone have one size, patch_half_width / across.
struct QuarterBall {
  double radius = 1;            ///< R [length]
  double patch_half_width = 0;  ///< arc from the pole to the edge of the bottom patch [length]
  double contact_radius = 0;    ///< horizontal distance from the axis up to which the sphere may
                                ///< come into contact [length]
  int across = 1;               ///< elements from the pole to the edge of the patch
  int height = 1;               ///< elements from the edge of the patch to the mid-plane
  int layers = 1;               ///< elements from the core to the sphere

  /// 2 across^2 (height + layers) + 4 across height layers.
  int elements() const { return 2 * across * (across * (height + layers) + 2 * height * layers); }
  /// Those of the core's skin, which the layers repeat, are (2 across + 1) (across + 1) at the
  /// bottom and 4 across + 1 above each other.
  int nodes() const {
    const int bottom = (2 * across + 1) * (across + 1);
    return bottom * (height + 1) + (bottom + (4 * across + 1) * height) * layers;
  }
};

/// The ball touches z = 0 at the origin; its centre is (0, 0, R). The mesh is the part y >= 0, z <=
/// R. Boundary parts: "contact" (the sphere, facets with a corner within `contact_radius`), "free"
/// (the rest of the sphere, which may be empty), "symmetry" (y = 0, exactly), "top" (z = R,
/// exactly). Throws InputError if the half width of the patch is not between 0 and R, so that there
/// is no room for the sides, or if a count is not positive.
Mesh<3> quarter_ball(const QuarterBall& ball);

}  // namespace gnomon
