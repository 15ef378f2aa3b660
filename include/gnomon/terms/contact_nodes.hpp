// The interface of a term that holds the contact of a state: with a rigid body, or of two surfaces.
#pragma once

#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/term.hpp>
#include <vector>

namespace gnomon {

template <int dim>
class ContactNodes : public Term<dim> {
public:
  /// The contact law at every contact node.
  virtual std::vector<ContactNode<dim>> nodes(const Evaluation<dim>& at) const = 0;
};

}  // namespace gnomon
