// The nodes of a surface that is uniform along a direction, on lines along it.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

struct SurfaceLines {
  std::vector<std::vector<int>> nodes;  ///< mesh nodes of each line, from one end to the other
  double length = 0;                    ///< of every line [length]
};

/// `along`: unit. In the plane the surface is a single line. Throws InputError where a node lies on
/// no line that goes from one end of the surface to the other.
template <int dim>
SurfaceLines lines_of_surface(const Mesh<dim>& mesh,
                              const std::vector<typename Mesh<dim>::Facet>& facets,
                              const Vector<dim>& along);

}  // namespace gnomon
