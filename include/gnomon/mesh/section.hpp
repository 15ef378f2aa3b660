// What a mesh in 2D is a section of.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

/// A scene in 2D is a section of bodies that are the same along the third direction, or of bodies
/// of revolution about r = 0, in coordinates (r, z): then areas and volumes are those of the whole
/// circumference. In 3D it is not read.
enum class Section { plane, meridian };

/// The nodes on the axis of a body of revolution, ascending: those with r = 0 but for a part of
/// 1e-9 of the largest r. They can move along the axis alone. Throws InputError if r < 0 at a node.
std::vector<int> axis_nodes(const Mesh<2>& mesh);

}  // namespace gnomon
