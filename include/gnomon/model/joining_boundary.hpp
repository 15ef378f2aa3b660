// The boundary that joins the contact: at the start what the counter-body can reach, and in an
// epoch of its own what it comes near to later.
#pragma once

#include <functional>
#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// A surface that touches but does not wear: the facets of the boundary outside of the surfaces of
/// `parts` of which `near` holds at a node. What supports hold across itself is left out, and what
/// has no area. Without facets where there are none.
template <int dim>
Surface<dim> joining_boundary(const AssemblyParts<dim>& parts,
                              const std::function<bool(const ContactPatch<dim>&)>& near);

/// Whether boundary of outward normal `own` meets a counter-body of normal `other` there; steeper
/// sides pass it by.
template <int dim>
bool faces(const Vector<dim>& own, const Vector<dim>& other) {
  constexpr double oblique = -0.5;  // cosine
  return other.allFinite() && other.dot(own) < oblique;
}

}  // namespace gnomon
