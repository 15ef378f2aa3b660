// The interface of a contact term whose friction may stick: where the nodes are on their partner.
#pragma once

#include <gnomon/terms/term.hpp>

namespace gnomon {

template <int dim>
class PlacesOnPartner {
public:
  virtual ~PlacesOnPartner() = default;
  /// r of every contact node, contact nodes x dim [length].
  virtual NodalField<dim> places(const Evaluation<dim>& at) const = 0;
};

}  // namespace gnomon
