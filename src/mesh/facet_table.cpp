#include "mesh/facet_table.hpp"

#include <algorithm>

namespace gnomon {

namespace {

/// Corners of the facets of a cell in VTK order: the body lies to the left of an edge, the corners
/// of a quadrilateral run counter-clockwise seen from outside.
constexpr int edges_of_quadrilateral[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr int facets_of_hexahedron[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                            {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

}  // namespace

template <int dim>
FacetTable<dim>::FacetTable(const Mesh<dim>& mesh)
    : mesh_(mesh), neighbour_(facets_per_cell * mesh.cells.size(), exterior) {
  for (int slot = 0; slot < slots(); ++slot) by_nodes_.push_back({sorted(facet(slot)), slot});
  std::sort(by_nodes_.begin(), by_nodes_.end());
  for (std::size_t k = 0, next = 0; k < by_nodes_.size(); k = next) {
    while (next < by_nodes_.size() && by_nodes_[next].first == by_nodes_[k].first) ++next;
    if (next - k == 2) {
      neighbour_[by_nodes_[k].second] = by_nodes_[k + 1].second;
      neighbour_[by_nodes_[k + 1].second] = by_nodes_[k].second;
    }
    if (next - k > 2)
      for (std::size_t same = k; same < next; ++same) neighbour_[by_nodes_[same].second] = crowded;
  }
}

template <int dim>
typename FacetTable<dim>::Facet FacetTable<dim>::facet(int slot) const {
  const auto& cell = mesh_.cells[slot / facets_per_cell];
  const int local = slot % facets_per_cell;
  Facet result;
  for (std::size_t a = 0; a < result.size(); ++a) {
    if constexpr (dim == 2)
      result[a] = cell[edges_of_quadrilateral[local][a]];
    else
      result[a] = cell[facets_of_hexahedron[local][a]];
  }
  return result;
}

template <int dim>
int FacetTable<dim>::find(std::span<const int> nodes) const {
  Facet wanted;
  if (nodes.size() != wanted.size()) return -1;
  std::copy(nodes.begin(), nodes.end(), wanted.begin());
  const auto found =
      std::lower_bound(by_nodes_.begin(), by_nodes_.end(), std::pair(sorted(wanted), 0));
  return found != by_nodes_.end() && found->first == sorted(wanted) ? found->second : -1;
}

template <int dim>
std::vector<typename FacetTable<dim>::Facet> FacetTable<dim>::exterior_facets() const {
  std::vector<Facet> result;
  for (int slot = 0; slot < slots(); ++slot)
    if (neighbour(slot) == exterior) result.push_back(facet(slot));
  return result;
}

template class FacetTable<2>;
template class FacetTable<3>;

}  // namespace gnomon
