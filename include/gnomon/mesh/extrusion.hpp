// A plane mesh extruded along a straight line: bodies whose shape may be one field of a
// cross-section (sec. 4.3, a groove that is uniform along the sliding direction).
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

struct Extrusion {
  Mesh<3> mesh;
  Mesh<2> section;  ///< in the plane (y, z)
  std::vector<int>
      section_node;  ///< one for each node of `mesh`: the node of `section` it was carried from
};

/// Extrudes a section in the plane (y, z) along x. `lines`: ascending values of x [length], at
/// least two. The nodes of one line along x follow one another. Boundary parts keep the names that
/// they have in the section; the two ends are "begin" and "end". Throws Error on lines that do
/// not ascend.
Extrusion extrude(const Mesh<2>& section, const std::vector<double>& lines);

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
