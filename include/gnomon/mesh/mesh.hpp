// Meshes of 4-node quadrilaterals (2D) and 8-node hexahedra (3D) in the initial configuration.
#pragma once

#include <array>
#include <functional>
#include <gnomon/base/tensor.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

template <int dim>
struct Mesh {
  static constexpr int cell_nodes = 1 << dim;
  static constexpr int facet_nodes = 1 << (dim - 1);
  using Cell = std::array<int, cell_nodes>;    ///< VTK order
  using Facet = std::array<int, facet_nodes>;  ///< boundary facet, outer normal by the order: in 2D
                                               ///< the body lies to the left of 0 -> 1, in 3D the
                                               ///< corners run counter-clockwise seen from outside

  std::vector<Vector<dim>> nodes;  ///< X^, initial positions [length]
  std::vector<Cell> cells;
  std::map<std::string, std::vector<Facet>> boundary;  ///< facets of each named boundary part

  /// Initial positions of the nodes of a cell, one row per node [length].
  CellNodal<dim> positions(const Cell& cell) const {
    CellNodal<dim> X;
    for (int a = 0; a < cell_nodes; ++a) X.row(a) = nodes[cell[a]].transpose();
    return X;
  }

  /// Nodes of a named boundary part, ascending, each once. Throws InputError with the names that
  /// there are.
  std::vector<int> boundary_nodes(const std::string& name) const;
};

/// A named part of a mesh in the form in which a result keeps it, so that a body whose mesh came
/// from a file can be made again from its result alone.
struct MeshPart {
  enum class Kind { exterior, facets, points, cells };
  Kind kind = Kind::facets;
  std::string name;        ///< empty for the exterior
  std::vector<int> nodes;  ///< of its facets, one after the other, or its points; or cells
};

/// nx by ny quadrilaterals on the image of the unit square under `place(s, t)`; boundary parts
/// "bottom" (t = 0), "top" (t = 1), "left" (s = 0), "right" (s = 1). The map must keep orientation.
Mesh<2> structured_quadrilaterals(int nx, int ny,
                                  const std::function<Vector<2>(double s, double t)>& place);

/// All facets that belong to one cell only, with outer normal, in the order of the cells.
template <int dim>
std::vector<typename Mesh<dim>::Facet> exterior_facets(const Mesh<dim>& mesh);

}  // namespace gnomon
