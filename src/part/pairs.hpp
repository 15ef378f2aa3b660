// Contact of bodies with each other: [[pair]] and [[motion]].
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/scene/scene.hpp>
#include <vector>

namespace gnomon::part {

/// Sets pairs, surfaces, approach and speed of parts that have bodies, supports and loads: all
/// boundary of the bodies that faces the partner. Throws InputError.
template <int dim>
void read_pairs(const Scene& scene, const ImportedBody<dim>& part, AssemblyParts<dim>& parts);

/// What touches, as surfaces: those that wear by name, and the rest; of tracks the whole. Throws
/// InputError where one that wears faces no other body.
template <int dim>
std::vector<Surface<dim>> surfaces_of(const Scene& scene, const ImportedBody<dim>& part,
                                      const std::vector<MortarPair<dim>>& pairs);

/// (pair_contact.cpp) Leaves what can touch in a run that is expected to have these magnitudes, and
/// chooses slaves.
template <int dim>
void restrict_pairs(const Scene& scene, const ImportedBody<dim>& part, const Magnitudes& expected,
                    AssemblyParts<dim>& parts);

/// Where supports hold a node of a slave in some directions, as in a symmetry, its normal lies in
/// the others.
template <int dim>
void keep_normals_to_supports(AssemblyParts<dim>& parts);

}  // namespace gnomon::part
