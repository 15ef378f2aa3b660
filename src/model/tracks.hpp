// Surfaces that are uniform along a line, as a groove along its track: nodes on a line share their
// shape.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <string>
#include <vector>

namespace gnomon {

template <int dim>
struct SharedShape {
  std::vector<int> carrier;     ///< Assembly::carrier
  NodalField<dim> direction{};  ///< Assembly::shape_direction
  std::vector<double> weight;   ///< Assembly::wear_weight
  std::vector<double> length;   ///< Assembly::track_length
};

/// Of the cross-section, or of surfaces with a track, which alone have lengths; all are empty
/// where there is neither. Throws
/// InputError where the nodes of a line are not held alike.
template <int dim>
SharedShape<dim> shared_shape(const AssemblyParts<dim>& parts,
                              const std::vector<ContactPatch<dim>>& patches);

/// The surface whose contact, in some phase, reaches an end of the mesh of its track; empty: none.
template <int dim>
std::string find_touched_end(const Assembly<dim>& assembly,
                             const std::vector<PhaseContact<dim>>& contacts);

/// By body: what the rest of their tracks, of which the mesh is a part, has lost [volume].
template <int dim>
std::vector<double> worn_beyond_mesh(const Assembly<dim>& assembly, const NodalField<dim>& d);

}  // namespace gnomon
