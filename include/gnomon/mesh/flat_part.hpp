// Whether a part of the boundary is flat: supports of the shape follow from that.
#pragma once

#include <gnomon/mesh/mesh.hpp>

namespace gnomon {

/// Outwards, of the length of the area (2D: length).
Vector<2> area_vector(const Mesh<2>& mesh, const Mesh<2>::Facet& facet);
Vector<3> area_vector(const Mesh<3>& mesh, const Mesh<3>::Facet& facet);

template <int dim>
struct FlatPart {
  bool flat = false;
  Vector<dim> normal = Vector<dim>::Zero();  ///< outer unit normal, the mean one where not flat
  double deviation = 0;  ///< of a node from the mean plane, at most, by the size of the part
};

/// A part is flat when its nodes deviate by less than `tolerance` times its size from one plane
/// (2D: line) and all facets face the same way. No facets are not flat.
template <int dim>
FlatPart<dim> flat_part(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                        double tolerance = 1e-6);

/// The number of planes (2D: lines) that a part consists of where these are few and apart:
/// parallel, or at 30 degrees or more to each other. 0 for a part that is curved.
template <int dim>
int planes_of(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
              double tolerance = 1e-6);

}  // namespace gnomon
