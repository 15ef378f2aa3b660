// Gaps between facets of two bodies that need not touch.
#pragma once

#include <array>
#include <gnomon/mesh/section.hpp>
#include <gnomon/terms/mortar_pair.hpp>
#include <vector>

namespace gnomon {

/// What of two sides meets along the slave's normals.
struct Cover {
  double area = 0;
  double volume = 0;  ///< of the gap; less than zero where the sides overlap
};

/// By facet of the slave, and of the master: the smallest mean gap to one of the other side;
/// infinite where it meets none [length].
using FacetGaps = std::array<std::vector<double>, 2>;

/// Facets meet along the slave's normals, nodes at x, with a gap in this range. `cover`: all that
/// meets is added to it.
template <int dim>
FacetGaps facet_gaps(const std::vector<typename Mesh<dim>::Facet>& slave,
                     const std::vector<typename Mesh<dim>::Facet>& master,
                     const std::vector<Vector<dim>>& x, Section section,
                     const std::array<double, 2>& range, Cover* cover = nullptr);

/// How deep facets of the slave lie in those of the master, by `most` or less [length].
template <int dim>
double deepest_overlap(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x,
                       Section section, double most);

}  // namespace gnomon
