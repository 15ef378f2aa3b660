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

/// Declares the switching functions of a contact node: so many of contact, then those of its law.
inline void declare_switches(int node, std::size_t of_contact, const WearLaw& law,
                             TermStructure& structure) {
  structure.switch_node.insert(structure.switch_node.end(), of_contact + law.kinks(), node);
  structure.switch_jumps.insert(structure.switch_jumps.end(), of_contact, 0);
  for (std::size_t k = 0; k < law.kinks(); ++k) structure.switch_jumps.push_back(law.may_jump(k));
}

/// Declares the times of wear laws, and those of the motion that a partner is given.
template <int dim>
void declare_times(const std::vector<WearLaw>& laws, const std::vector<Guide<dim>>& guides,
                   TermStructure& structure) {
  const auto add = [](const std::vector<double>& more, std::vector<double>& times) {
    times.insert(times.end(), more.begin(), more.end());
  };
  for (const WearLaw& law : laws) {
    add(law.breakpoints(), structure.breakpoints);
    add(law.stops(), structure.stops);
  }
  for (const Guide<dim>& guide : guides)
    if (guide.travel) add(guide.travel->times(), structure.breakpoints);
}

}  // namespace gnomon
