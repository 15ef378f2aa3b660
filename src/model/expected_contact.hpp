// Where bodies are expected to touch over a run, by the gaps of the unworn bodies.
#pragma once

#include <gnomon/model/magnitudes.hpp>
#include <map>
#include <vector>

namespace gnomon {

/// By contact node that the partner can meet (of pairs those of the slaves, with `masters` of both
/// sides): how far the partner still has to come when the first node touches, under a force in each
/// phase by itself; the least of all phases [length].
template <int dim>
std::map<int, double> gaps_over_cycle(const AssemblyParts<dim>& parts, bool masters = false);

/// A part of the unworn bodies.
template <int dim>
struct Ball {
  Vector<dim> centre;
  double radius = 0;  ///< the longest edge of the contact facets at the centre [length]
};

/// Around every node that wear and deformation are expected to bring into contact.
template <int dim>
std::vector<Ball<dim>> expected_contact(const AssemblyParts<dim>& parts,
                                        const Magnitudes& expected);

}  // namespace gnomon
