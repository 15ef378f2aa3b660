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

}  // namespace gnomon
