// The boundary that joins the contact: at the start what the counter-body can reach, and in an
// epoch of its own what it comes near to later.
#pragma once

#include <functional>
#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// The boundary outside of the surfaces of `parts`, but for what supports hold across itself and
/// what has no area.
template <int dim>
class OtherBoundary {
public:
  explicit OtherBoundary(const AssemblyParts<dim>& parts);

  /// A surface that touches but does not wear: the facets of which `near` holds at a node. Without
  /// facets where there are none.
  Surface<dim> joining(const std::function<bool(const ContactPatch<dim>&)>& near) const;

private:
  std::vector<typename Mesh<dim>::Facet> facets_;
  std::vector<ContactPatch<dim>> patches_;  // of their nodes
};

/// Whether boundary of outward normal `own` meets a counter-body of normal `other` there; steeper
/// sides pass it by.
template <int dim>
bool faces(const Vector<dim>& own, const Vector<dim>& other) {
  constexpr double oblique = -0.5;  // cosine
  return other.allFinite() && other.dot(own) < oblique;
}

}  // namespace gnomon
