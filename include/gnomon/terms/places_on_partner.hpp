// Contact terms whose friction may stick: where the nodes are on their partner, and were before.
#pragma once

#include <gnomon/terms/term.hpp>

namespace gnomon {

/// A row of a nodal field, times a factor.
struct PartOfPlace {
  FieldId field;
  Eigen::Index row;
  double factor = 1;
};

template <int dim>
class PlacesOnPartner {
public:
  virtual ~PlacesOnPartner() = default;
  /// r of every contact node, contact nodes x dim [length].
  virtual NodalField<dim> places(const Evaluation<dim>& at) const = 0;
};

}  // namespace gnomon
