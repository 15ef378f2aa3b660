// Wear as a gap: the worn depth is a distance between a body that keeps its shape and its partner
// (Stroemberg 1997, reference 18 of the paper).
#pragma once

#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// The shape of contact nodes moves along one fixed direction m each, that of all others is held,
/// and no cell is moved. m is the direction in which the partner comes, where the whole surface
/// faces it, else the initial normal (in a bore), within what the given motion allows. With the
/// conservative rule the depth h grows by hdot = Wdot A / (a.m), a the derivative of the volume by
/// the position of the node on the worn surface, so that what is lost is what wears.
/// Throws InputError with another rule or with the multiplier form of the constraint.
template <int dim>
ShapeMotion<dim> gap_motion(const AssemblyParts<dim>& parts);

/// Whether a point of the boundary beside the contact lies in what has been worn away, so that it
/// means nothing that the partner has passed it: it is no farther from a contact node than this has
/// worn. Of a mesh that follows the wear nothing does.
template <int dim>
bool is_worn_away(const Assembly<dim>& assembly, const NodalField<dim>& d, const Vector<dim>& X);

}  // namespace gnomon
