// The surfaces of a part: those that wear, with their laws (wear.on, wear.surfaces.NAME.rate), and
// the boundary beside them that the counter-body can touch.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// The surfaces of wear.on, in this order, whose laws are not read yet. Throws InputError where two
/// of them share a facet.
template <int dim>
std::vector<Surface<dim>> wearing_surfaces(const Scene& scene, const ImportedBody<dim>& part);

/// The law of a surface at its nominal speed: its own, or wear.rate. Throws InputError.
WearLaw read_surface_law(const Scene& scene, const std::string& surface, double speed);

/// Throws InputError where the expression of `key` reads z0 in the plane, where it is zero.
template <int dim>
void require_positions(const Scene& scene, const std::string& key);

/// What the law of a surface meets, at its own speed and nodes.
template <int dim>
WearCircumstances circumstances_of(const AssemblyParts<dim>& parts, const Surface<dim>& surface);

/// Checks and completes the laws for the values that a run may meet (required_law()). To be called
/// when scales are known. Throws InputError.
template <int dim>
void complete_surface_laws(const Scene& scene, AssemblyParts<dim>& parts);

/// A surface that touches but does not wear: the facets of the boundary, outside of the surfaces
/// that `parts` have, that face the counter-body in some instant and that it reaches when it moves
/// by `depth` beyond its first touch. Without facets where there are none. What supports hold
/// across itself is left out.
template <int dim>
Surface<dim> reachable_boundary(const AssemblyParts<dim>& parts, double depth);

}  // namespace gnomon::part
