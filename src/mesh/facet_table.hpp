// Which cells share which facets.
#pragma once

#include <algorithm>
#include <gnomon/mesh/mesh.hpp>
#include <set>
#include <span>

namespace gnomon {

/// The nodes of a facet in ascending order, to compare facets that begin with different corners.
template <class Facet>
Facet sorted(Facet facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

/// The nodes that facets have, ascending.
template <class Facets>
std::set<int> nodes_of_facets(const Facets& facets) {
  std::set<int> nodes;
  for (const auto& facet : facets) nodes.insert(facet.begin(), facet.end());
  return nodes;
}

/// Sorts, and leaves one of equal entries.
template <class Entry>
void sort_once(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

/// Facets of all cells by slots, facets_per_cell * cell + number in the cell.
template <int dim>
class FacetTable {
public:
  using Facet = typename Mesh<dim>::Facet;
  static constexpr int facets_per_cell = 2 * dim;
  static constexpr int exterior = -1;  ///< no neighbour
  static constexpr int crowded = -2;   ///< more than one

  /// The mesh has to outlive the table.
  explicit FacetTable(const Mesh<dim>& mesh);

  int slots() const { return static_cast<int>(neighbour_.size()); }
  Facet facet(int slot) const;
  /// The slot of the same facet in the neighbouring cell, or one of the numbers above.
  int neighbour(int slot) const { return neighbour_[slot]; }
  /// A slot with these nodes in any order; -1 where there is none, as with a node that is -1.
  int find(std::span<const int> nodes) const;
  /// All facets without a neighbour, in the order of the cells.
  std::vector<Facet> exterior_facets() const;

private:
  const Mesh<dim>& mesh_;
  std::vector<std::pair<Facet, int>> by_nodes_;  // sorted nodes and slot of each facet, ascending
  std::vector<int> neighbour_;
};

}  // namespace gnomon
