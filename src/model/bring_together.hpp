// Bodies that contact alone holds are moved, before a run starts, to where they touch.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <limits>

namespace gnomon {

/// By node: the number of the connected part of the mesh to which it belongs.
template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh);

/// By body: that of its cells.
template <int dim>
std::vector<int> connected_parts(const Mesh<dim>& mesh, const std::vector<Body>& bodies);

/// By node: the last of the bodies that have it, by those of the cells.
template <int dim>
std::vector<int> body_of_nodes(const Mesh<dim>& mesh, const std::vector<int>& body_of_cells);

/// The simplices of a facet: itself, or two triangles.
template <int dim>
std::vector<std::array<int, dim>> simplices(const typename Mesh<dim>::Facet& facet);

/// Where the line from a point along e meets the plane of a simplex.
template <int dim>
struct Crossing {
  double distance =
      std::numeric_limits<double>::infinity();  ///< negative behind the point [length]
  /// Of the corners, of sum 1; negative ones: it passes by.
  Vector<dim> shares = Vector<dim>::Constant(-1);

  Crossing(const Vector<dim>& point, const Vector<dim>& e, const std::array<int, dim>& simplex,
           const std::vector<Vector<dim>>& x);
};

/// How far the master of a pair goes along e, a unit vector, to touch the slave, where the nodes
/// are at `x`: negative where they overlap, infinite where it passes by [length].
template <int dim>
double travel_to_touch(const MortarPair<dim>& pair, const Vector<dim>& e,
                       const std::vector<Vector<dim>>& x);
/// The same along its approach for every node of the slave's facets by itself.
template <int dim>
std::map<int, double> travels_of_slave(const MortarPair<dim>& pair,
                                       const std::vector<Vector<dim>>& x);

/// Displacements of bodies that supports let move along the approach of a pair, or slantwise to it,
/// nodes x dim: to where the pairs touch [length], and of the length one in the same direction,
/// both in the frames of the bodies, whose places these are.
template <int dim>
struct Touching {
  NodalField<dim> displacement, direction;

  Touching(const AssemblyParts<dim>& parts, const std::vector<BodyPlace<dim>>& places);
};

}  // namespace gnomon
