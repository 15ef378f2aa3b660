// Named parts of a mesh in the form in which a result keeps them.
#pragma once

#include <string>
#include <vector>

namespace gnomon {

/// So that a body whose mesh came from a file can be made again from its result alone.
struct MeshPart {
  enum class Kind { exterior, facets, points, cells };
  Kind kind = Kind::facets;
  std::string name;        ///< empty for the exterior
  std::vector<int> nodes;  ///< of its facets, one after the other, or its points; or cells
};

}  // namespace gnomon
