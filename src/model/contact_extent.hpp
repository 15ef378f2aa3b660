// How far contact reaches: between which nodes it ends, and what a mesh cannot know of it.
#pragma once

#include <gnomon/model/wear_model.hpp>

namespace gnomon {

struct ContactArea {
  double area = 0;     ///< of the nodes in contact, along the worn surface; in 2D a width
  double unknown = 0;  ///< half of the facets of which only some nodes are
};

template <int dim>
ContactArea contact_area(const Assembly<dim>& body, const NodalField<dim>& d,
                         const std::vector<ContactNode<dim>>& nodes);

/// The largest pressure of the phases, if it is at a node beside an open one.
template <int dim>
std::optional<EdgePressure> edge_pressure(const Assembly<dim>& body,
                                          const std::vector<PhaseContact<dim>>& phases);

}  // namespace gnomon
