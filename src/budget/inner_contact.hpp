// The inside of the contact, away from its edges, where pressures converge.
#pragma once

#include <gnomon/model/model.hpp>
#include <vector>

namespace gnomon::budget {

/// Of each node of a surface the others in its cells; none where there is no grid.
std::vector<std::vector<std::size_t>> surface_neighbours(const std::optional<Grid>& grid,
                                                         const ContactSurface& surface);

/// Connected nodes under pressure. Where no neighbours are known they are one patch.
std::vector<std::vector<std::size_t>> patches_of(
    const ContactSurface& surface, const std::vector<std::vector<std::size_t>>& neighbours);

/// The nodes under pressure within 0.9 of each connected patch of the contact, from its middle to
/// its edge. An ellipse stands for a patch: that of the covariance of its nodes, as large as the
/// farthest of them. A patch that ends at a plane of symmetry, x, y or z = constant along whose
/// normal no node there moves, is taken with its mirror image. One that goes all
/// round in the plane has no edge and is all inside. Patches of less than three nodes count only
/// where there is no larger one.
std::vector<std::size_t> inner_nodes(const ContactSurface& surface,
                                     const std::vector<std::vector<std::size_t>>& neighbours);

/// Of these nodes those that are not among the two next to nodes without pressure, if there are
/// three: the last nodes of a master carry a part of the pressure.
std::vector<std::size_t> without_edges(const ContactSurface& surface,
                                       const std::vector<std::vector<std::size_t>>& neighbours,
                                       const std::vector<std::size_t>& inner);

/// Whether pressure reaches to the edges of a plane contact: 0 where it falls to the ends of these
/// nodes as an ellipse over the contact does, or is not known, 1 where it is that in their middle.
double reaches_edges(const ContactSurface& surface, const std::vector<std::size_t>& inner);

}  // namespace gnomon::budget
