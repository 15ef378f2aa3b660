// Which bodies of a mesh face each other, and with which parts of their boundary.
#pragma once

#include <array>
#include <gnomon/mesh/imported_body.hpp>
#include <string>
#include <vector>

namespace gnomon::app {

/// Two bodies by their numbers, one before the other, where they are nearest to each other.
template <int dim>
struct Encounter {
  std::array<int, 2> bodies;
  double gap = 0;      ///< between the centres of the nearest facets [length]
  bool touch = false;  ///< no farther apart than these facets are long
  /// Named parts of each side that are about as near, and all their facets on that body; of
  /// boundary without names the facets alone that are so.
  std::array<std::vector<std::string>, 2> parts{};
  std::array<std::vector<typename Mesh<dim>::Facet>, 2> facets{};
};

/// By node: the number of the body in `names`, groups of cells; -1 in none.
template <int dim>
std::vector<int> bodies_of_nodes(const ImportedBody<dim>& body,
                                 const std::vector<std::string>& names);

/// All bodies that face each other, the nearest first.
template <int dim>
std::vector<Encounter<dim>> find_encounters(const ImportedBody<dim>& body,
                                            const std::vector<std::string>& names);

}  // namespace gnomon::app
