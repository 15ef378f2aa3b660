#include <fmt/format.h>

#include <algorithm>

#include "mesh/import_cells.hpp"
#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

template <int dim>
std::string node_text(const ImportedBody<dim>& body, int node) {
  const Vector<dim>& X = body.mesh.nodes[node];
  const std::string place = place_text({X.data(), static_cast<std::size_t>(dim)});
  if (body.node_tags[node] == 0) return "the node at " + place;
  return fmt::format("node {} at {}", body.node_tags[node], place);
}

/// Neighbours on either side of a facet run through its nodes in opposite directions.
template <class Facet>
bool same_direction(const Facet& one, const Facet& other) {
  const auto at = std::find(other.begin(), other.end(), one[0]) - other.begin();
  return other.size() == 2 ? at == 0 : other[(at + 1) % other.size()] == one[1];
}

template <int dim>
void check_overlaps(const ImportedBody<dim>& body, const FacetTable<dim>& facets) {
  for (int slot = 0; slot < facets.slots(); ++slot) {
    const int other = facets.neighbour(slot), cell = slot / facets.facets_per_cell;
    if (other == facets.crowded)
      refuse_body(body, fmt::format("more than two cells meet at a side of {}, expected cells that "
                                    "do not overlap",
                                    cell_text(body, cell)));
    if (other > slot && same_direction(facets.facet(slot), facets.facet(other)))
      refuse_body(
          body, fmt::format("{} and {} overlap, expected cells side by side", cell_text(body, cell),
                            cell_text(body, other / facets.facets_per_cell)));
  }
}

/// Number of the part that each cell belongs to, found through facets.
template <int dim>
std::vector<int> parts_of(const ImportedBody<dim>& body, const FacetTable<dim>& facets) {
  constexpr int per_cell = FacetTable<dim>::facets_per_cell;
  std::vector<int> part(body.mesh.cells.size(), -1), open;
  int parts = 0;
  for (int seed = 0; seed < static_cast<int>(part.size()); ++seed) {
    if (part[seed] >= 0) continue;
    part[seed] = parts;
    open.push_back(seed);
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      for (int slot = per_cell * cell; slot < per_cell * (cell + 1); ++slot) {
        if (facets.neighbour(slot) < 0) continue;
        const int next = facets.neighbour(slot) / per_cell;
        if (part[next] >= 0) continue;
        part[next] = parts;
        open.push_back(next);
      }
    }
    ++parts;
  }
  return part;
}

template <int dim>
void check_one_part(const ImportedBody<dim>& body, const FacetTable<dim>& facets) {
  const std::vector<int> part = parts_of(body, facets);
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  if (parts == 1) return;
  std::vector<int> cells(parts, 0), first(parts, -1);
  for (int cell = 0; cell < static_cast<int>(part.size()); ++cell) {
    if (first[part[cell]] < 0) first[part[cell]] = cell;
    ++cells[part[cell]];
  }
  refuse_body(
      body,
      fmt::format("the body consists of {} parts that share no side of a cell, for example {} with "
                  "{} and {} with {}; expected one part",
                  parts, counted(cells[0], "cell"), cell_text(body, first[0]),
                  counted(cells[1], "cell"), cell_text(body, first[1])));
}

/// Every node of a closed curve begins one of its edges.
void check_pinches(const ImportedBody<2>& body) {
  std::vector<char> begins(body.mesh.nodes.size(), 0);
  for (const auto& facet : body.exterior) {
    if (begins[facet[0]])
      refuse_body(body, fmt::format("the body touches itself in {} only, expected sides of cells "
                                    "to be shared there",
                                    node_text(body, facet[0])));
    begins[facet[0]] = 1;
  }
}

/// Every edge of a closed surface belongs to two of its facets, once in either direction.
void check_pinches(const ImportedBody<3>& body) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(4 * body.exterior.size());
  for (const auto& facet : body.exterior)
    for (int a = 0; a < 4; ++a) edges.push_back({facet[a], facet[(a + 1) % 4]});
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end())
    refuse_body(body, fmt::format("the body touches itself in the edge from {} to {} only, "
                                  "expected sides of cells to be shared there",
                                  node_text(body, (*twice)[0]), node_text(body, (*twice)[1])));
}

}  // namespace

template <int dim>
void check_connection(const ImportedBody<dim>& body, const FacetTable<dim>& facets) {
  check_overlaps(body, facets);
  check_hanging_nodes(body);
  check_one_part(body, facets);
  check_pinches(body);
}

template void check_connection(const ImportedBody<2>&, const FacetTable<2>&);
template void check_connection(const ImportedBody<3>&, const FacetTable<3>&);

}  // namespace gnomon
