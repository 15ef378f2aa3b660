#include <fmt/format.h>

#include <Eigen/Geometry>
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
      refuse_mesh(body.file,
                  fmt::format("more than two cells meet at a side of {}, expected cells that "
                              "do not overlap",
                              cell_text(body, cell)));
    if (other > slot && same_direction(facets.facet(slot), facets.facet(other)))
      refuse_mesh(body.file, fmt::format("{} and {} overlap, expected cells side by side",
                                         cell_text(body, cell),
                                         cell_text(body, other / facets.facets_per_cell)));
  }
}

/// How near to a facet, by its size, a node hangs on it; a gap so narrow is none that was meant.
constexpr double nearness = 1e-3;

template <int dim>
Vector<dim> nearest_on_segment(const Vector<dim>& x, const Vector<dim>& a, const Vector<dim>& b) {
  const Vector<dim> along = b - a;
  return a + std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

/// Nearest point of a triangle; of its sides where the projection falls outside.
Vector<3> nearest_on_triangle(const Vector<3>& x, const std::array<Vector<3>, 3>& corners) {
  const Vector<3> a = corners[1] - corners[0], b = corners[2] - corners[0];
  const Vector<3> n = a.cross(b);
  const Vector<3> from = x - corners[0];
  const double s = from.cross(b).dot(n) / n.squaredNorm();
  const double t = a.cross(from).dot(n) / n.squaredNorm();
  if (s >= 0 && t >= 0 && s + t <= 1) return corners[0] + s * a + t * b;
  Vector<3> best = corners[0];
  for (int k = 0; k < 3; ++k) {
    const Vector<3> point = nearest_on_segment<3>(x, corners[k], corners[(k + 1) % 3]);
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

Vector<2> nearest_on_facet(const Vector<2>& x, const std::array<Vector<2>, 2>& facet) {
  return nearest_on_segment<2>(x, facet[0], facet[1]);
}

/// Of the four triangles between the centroid and the sides.
Vector<3> nearest_on_facet(const Vector<3>& x, const std::array<Vector<3>, 4>& facet) {
  const Vector<3> centre = (facet[0] + facet[1] + facet[2] + facet[3]) / 4;
  Vector<3> best = centre;
  for (int a = 0; a < 4; ++a) {
    const Vector<3> point = nearest_on_triangle(x, {centre, facet[a], facet[(a + 1) % 4]});
    if ((x - point).norm() < (x - best).norm()) best = point;
  }
  return best;
}

/// Nodes of the boundary, ascending in the first coordinate.
template <int dim>
std::vector<int> sorted_nodes(const ImportedBody<dim>& body) {
  std::vector<int> nodes;
  for (const auto& facet : body.exterior) nodes.insert(nodes.end(), facet.begin(), facet.end());
  sort_once(nodes);
  const auto& X = body.mesh.nodes;
  std::ranges::stable_sort(nodes, {}, [&X](int node) { return X[node][0]; });
  return nodes;
}

template <int dim>
bool hangs(const Vector<dim>& x, const typename Mesh<dim>::Facet& facet,
           const std::vector<Vector<dim>>& nodes, double margin) {
  std::array<Vector<dim>, Mesh<dim>::facet_nodes> corners;
  for (std::size_t a = 0; a < facet.size(); ++a) corners[a] = nodes[facet[a]];
  const Vector<dim> point = nearest_on_facet(x, corners);
  if ((x - point).norm() > margin) return false;
  // The next nodes along the boundary are near to a corner at most.
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector<dim>& corner) { return (point - corner).norm() > margin; });
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

/// By node: the number of the part that it belongs to.
template <int dim>
std::vector<int> parts_of_nodes(const ImportedBody<dim>& body, const std::vector<int>& parts) {
  std::vector<int> part(body.mesh.nodes.size(), -1);
  for (std::size_t cell = 0; cell < parts.size(); ++cell)
    for (const int node : body.mesh.cells[cell]) part[node] = parts[cell];
  return part;
}

/// Refuses nodes of the boundary that lie within a facet of the boundary, where several parts are
/// allowed within one of their own.
template <int dim>
void check_hanging_nodes(const ImportedBody<dim>& body, const std::vector<int>& part) {
  const auto& X = body.mesh.nodes;
  const std::vector<int> nodes = sorted_nodes(body);
  for (const auto& facet : body.exterior) {
    Eigen::AlignedBox<double, dim> box;
    for (int node : facet) box.extend(X[node]);
    const double margin = nearness * box.diagonal().norm();
    box.min().array() -= margin;
    box.max().array() += margin;
    auto at =
        std::ranges::lower_bound(nodes, box.min()[0], {}, [&X](int node) { return X[node][0]; });
    for (; at != nodes.end() && X[*at][0] <= box.max()[0]; ++at) {
      if (!box.contains(X[*at]) || part[*at] != part[facet[0]]) continue;
      if (std::find(facet.begin(), facet.end(), *at) != facet.end()) continue;
      if (hangs<dim>(X[*at], facet, X, margin))
        throw UnconnectedCells(
            fmt::format("{}: {} hangs: it lies at {} within the side of a cell, of which it is no "
                        "corner; expected cells that meet side to side (in Gmsh: Coherence, or "
                        "BooleanFragments, before meshing)",
                        body.file,
                        body.node_tags[*at] == 0 ? std::string("a node")
                                                 : fmt::format("node {}", body.node_tags[*at]),
                        place_text({X[*at].data(), static_cast<std::size_t>(dim)})));
    }
  }
}

template <int dim>
void check_parts(const ImportedBody<dim>& body, const std::vector<int>& part, std::size_t most) {
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  if (parts <= static_cast<int>(most)) return;
  std::vector<int> cells(parts, 0), first(parts, -1);
  for (int cell = 0; cell < static_cast<int>(part.size()); ++cell) {
    if (first[part[cell]] < 0) first[part[cell]] = cell;
    ++cells[part[cell]];
  }
  throw UnconnectedCells(fmt::format(
      "{}: the body consists of {} parts that share no side of a cell, for example {} with "
      "{} and {} with {}; expected {}",
      body.file, parts, counted(cells[0], "cell"), cell_text(body, first[0]),
      counted(cells[1], "cell"), cell_text(body, first[1]),
      most > 1 ? fmt::format("the {} of [[pair]]", most)
               : fmt::format("one part, or a [[body]] for each, with a `mesh` of its "
                             "own or as a Physical {} (in Gmsh: a .geo script, which "
                             "may Merge this file)",
                             dim == 2 ? "Surface" : "Volume")));
}

/// Every node of a closed curve begins one of its edges.
void check_pinches(const ImportedBody<2>& body) {
  std::vector<char> begins(body.mesh.nodes.size(), 0);
  for (const auto& facet : body.exterior) {
    if (begins[facet[0]])
      refuse_mesh(body.file,
                  fmt::format("the body touches itself in {} only, expected sides of cells "
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
    refuse_mesh(body.file, fmt::format("the body touches itself in the edge from {} to {} only, "
                                       "expected sides of cells to be shared there",
                                       node_text(body, (*twice)[0]), node_text(body, (*twice)[1])));
}

}  // namespace

template <int dim>
void check_connection(const ImportedBody<dim>& body, const FacetTable<dim>& facets,
                      std::size_t most_parts) {
  check_overlaps(body, facets);
  const std::vector<int> part = parts_of(body, facets);
  check_hanging_nodes(body, most_parts > 1 ? parts_of_nodes(body, part)
                                           : std::vector<int>(body.mesh.nodes.size(), 0));
  check_parts(body, part, most_parts);
  check_pinches(body);
}

template void check_connection(const ImportedBody<2>&, const FacetTable<2>&, std::size_t);
template void check_connection(const ImportedBody<3>&, const FacetTable<3>&, std::size_t);

}  // namespace gnomon
