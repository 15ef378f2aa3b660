// The section of a body that is uniform along x.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

/// The cross-section of a body whose shape stays uniform along x (sec. 4.3): the shape unknowns are
/// those of the section, with components (y, z).
struct CrossSection {
  Mesh<2> mesh;  ///< in the plane (y, z)
  std::vector<int>
      node;             ///< per section node, the node of the body that carries the shape unknowns
  std::vector<int> of;  ///< section node of every node of the body
  double length = 0;    ///< of the body along x [length]
  double path = 0;      ///< L, sliding length of a cycle, of which the body is a part [length]
};

}  // namespace gnomon
