// Bodies that contact alone holds are moved, before a run starts, to where they touch.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <map>
#include <vector>

namespace gnomon {

/// How far the master of a pair goes along e, a unit vector, to touch the slave, where the nodes
/// are at `x`: negative where they overlap, infinite where it passes by [length].
template <int dim>
double travel_to_touch(const MortarPair<dim>& pair, const Vector<dim>& e,
                       const std::vector<Vector<dim>>& x);
/// The same along its approach for every node of the slave's (0) or master's facets by itself.
template <int dim>
std::map<int, double> travels_of_side(const MortarPair<dim>& pair, int side,
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
