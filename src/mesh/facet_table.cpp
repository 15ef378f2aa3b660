#include "mesh/facet_table.hpp"

#include <algorithm>

namespace gnomon {

namespace {

/// Corners of the facets of a cell in VTK order: the body lies to the left of an edge, the corners
/// of a quadrilateral run counter-clockwise seen from outside.
constexpr int edges_of_quadrilateral[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr int facets_of_hexahedron[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                            {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

template <int dim>
int least_node(const typename Mesh<dim>::Facet& facet) {
  return *std::min_element(facet.begin(), facet.end());
}

}  // namespace

template <int dim>
FacetTable<dim>::FacetTable(const Mesh<dim>& mesh)
    : mesh_(mesh),
      start_(mesh.nodes.size() + 2, 0),
      neighbour_(facets_per_cell * mesh.cells.size(), exterior) {
  for (int slot = 0; slot < slots(); ++slot) ++start_[least_node<dim>(facet(slot)) + 2];
  for (std::size_t node = 2; node < start_.size(); ++node) start_[node] += start_[node - 1];
  slots_.resize(neighbour_.size());
  for (int slot = 0; slot < slots(); ++slot)
    slots_[start_[least_node<dim>(facet(slot)) + 1]++] = slot;
  start_.pop_back();
  for (int node = 0; node + 1 < static_cast<int>(start_.size()); ++node) {
    const std::span<const int> here = slots_at(node);
    for (std::size_t k = 0; k < here.size(); ++k) connect(here[k], here.subspan(k + 1));
  }
}

template <int dim>
void FacetTable<dim>::connect(int slot, std::span<const int> candidates) {
  const Facet own = sorted(facet(slot));
  for (int other : candidates) {
    if (sorted(facet(other)) != own) continue;
    const bool free = neighbour_[slot] == exterior && neighbour_[other] == exterior;
    neighbour_[slot] = free ? other : crowded;
    neighbour_[other] = free ? slot : crowded;
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
  wanted = sorted(wanted);
  if (wanted[0] < 0) return -1;
  for (int slot : slots_at(wanted[0]))
    if (sorted(facet(slot)) == wanted) return slot;
  return -1;
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
