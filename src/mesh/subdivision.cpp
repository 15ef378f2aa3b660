#include <fmt/format.h>

#include <algorithm>

#include "mesh/cell_faces.hpp"
#include "mesh/facet_table.hpp"
#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

bool contains(const CellFace& face, int node) {
  return std::find(face.begin(), face.end(), node) != face.end();
}

using FaceKey = std::array<int, 4>;

/// Nodes of a face of a cell with these nodes.
FaceKey nodes_of(const CellFace& face, std::span<const int> cell) {
  FaceKey nodes;
  for (int a = 0; a < 4; ++a) nodes[a] = face[a] < 0 ? -1 : cell[face[a]];
  return nodes;
}

/// Position among the sorted keys; -1 where there is none.
template <class Key>
int place_of(const std::vector<Key>& keys, const Key& key) {
  const auto found = std::lower_bound(keys.begin(), keys.end(), key);
  return found != keys.end() && *found == key ? static_cast<int>(found - keys.begin()) : -1;
}

class Subdivision {
public:
  Subdivision(const ImportedMesh& mesh, const EdgeBulges& bulges);
  ImportedMesh operator()();

private:
  void collect(int cell);
  void add_nodes();
  void add_node(std::span<const int> around, double part, std::span<const Edge> edges);
  int edge_node(int a, int b) const;
  int face_node(const FaceKey& nodes) const;
  void split_in_plane(std::span<const int> nodes, std::int64_t tag, int centre, ElementList& to);
  void split_in_space(int cell);
  void split_cells();
  void split_facets();
  void follow_groups();

  const ImportedMesh& old_;
  const EdgeBulges& bulges_;
  ImportedMesh result_;
  std::vector<Edge> edges_;
  std::vector<FaceKey> faces_;                           // in space, sorted nodes, -1 first
  std::map<FaceKey, std::vector<Edge>> edges_of_faces_;  // where edges have bulges
  std::vector<int> cell_start_, facet_start_;            // of the children of each
};

Subdivision::Subdivision(const ImportedMesh& mesh, const EdgeBulges& bulges)
    : old_(mesh), bulges_(bulges) {
  result_.file = mesh.file;
  result_.dimension = mesh.dimension;
  result_.nodes = mesh.nodes;
  result_.node_tags = mesh.node_tags;
  result_.remarks = mesh.remarks;
}

/// Edges of a cell or, by their nodes in this order, of a polygon.
std::vector<Edge> edges_around(std::span<const int> polygon) {
  std::vector<Edge> edges;
  for (std::size_t a = 0; a < polygon.size(); ++a)
    edges.push_back(edge_of(polygon[a], polygon[(a + 1) % polygon.size()]));
  return edges;
}

std::vector<Edge> edges_of(ElementKind kind, std::span<const int> nodes) {
  if (dimension_of(kind) == 2) return edges_around(nodes);
  std::vector<Edge> edges;
  for (const CellCorner& corner : faces_of(kind).corners)
    for (int k = 1; k < 4; ++k)
      if (corner[0] < corner[k]) edges.push_back(edge_of(nodes[corner[0]], nodes[corner[k]]));
  return edges;
}

void Subdivision::collect(int cell) {
  const std::span<const int> nodes = old_.cells.at(cell);
  const ElementKind kind = old_.cells.kinds[cell];
  const std::vector<Edge> edges = edges_of(kind, nodes);
  edges_.insert(edges_.end(), edges.begin(), edges.end());
  if (old_.dimension == 2) return;
  for (const CellFace& face : faces_of(kind).faces) faces_.push_back(sorted(nodes_of(face, nodes)));
  if (bulges_.empty()) return;
  for (const std::vector<int>& facet : facets_of(kind, nodes)) {
    FaceKey key = {-1, -1, -1, -1};
    std::ranges::copy(facet, key.begin());
    edges_of_faces_[sorted(key)] = edges_around(facet);
  }
}

/// In the middle of nodes, moved by a part of the bulges of the edges between them.
void Subdivision::add_node(std::span<const int> around, double part, std::span<const Edge> edges) {
  std::array<double, 3> middle{};
  for (int node : around)
    for (int i = 0; i < 3; ++i)
      middle[i] += old_.nodes[node][i] / static_cast<double>(around.size());
  if (!bulges_.empty())
    for (const Edge& edge : edges)
      if (const auto bulge = bulges_.find(edge); bulge != bulges_.end())
        for (int i = 0; i < 3; ++i) middle[i] += part * bulge->second[i];
  result_.nodes.push_back(middle);
  result_.node_tags.push_back(0);
}

/// Of a triangle or a quadrilateral.
double part_of_edges(std::size_t corners) {
  return corners == 3 ? 4.0 / 9 : 0.5;
}

/// Middles of faces and cells follow their edges as those of quadratic elements do; of a wedge
/// nearly so.
void Subdivision::add_nodes() {
  for (const Edge& edge : edges_) add_node(edge, 1, {&edge, 1});
  for (const FaceKey& face : faces_) {
    const std::span<const int> nodes = std::span(face).subspan(face[0] < 0 ? 1 : 0);
    const auto edges = edges_of_faces_.find(face);
    add_node(nodes, part_of_edges(nodes.size()),
             edges == edges_of_faces_.end() ? std::span<const Edge>() : edges->second);
  }
  for (int cell = 0; cell < old_.cells.size(); ++cell) {
    const std::span<const int> nodes = old_.cells.at(cell);
    constexpr double in_space = 0.25;
    add_node(nodes, old_.dimension == 2 ? part_of_edges(nodes.size()) : in_space,
             edges_of(old_.cells.kinds[cell], nodes));
  }
}

int Subdivision::edge_node(int a, int b) const {
  const int place = place_of(edges_, edge_of(a, b));
  return place < 0 ? -1 : static_cast<int>(old_.nodes.size()) + place;
}

int Subdivision::face_node(const FaceKey& nodes) const {
  const int place = place_of(faces_, sorted(nodes));
  return place < 0 ? -1 : static_cast<int>(old_.nodes.size() + edges_.size()) + place;
}

/// A polygon around the node `centre`.
void Subdivision::split_in_plane(std::span<const int> nodes, std::int64_t tag, int centre,
                                 ElementList& to) {
  const std::size_t count = nodes.size();
  for (std::size_t a = 0; a < count; ++a) {
    const int next = nodes[(a + 1) % count], previous = nodes[(a + count - 1) % count];
    const int child[] = {nodes[a], edge_node(nodes[a], next), centre,
                         edge_node(nodes[a], previous)};
    to.add(ElementKind::quadrilateral, tag, child);
  }
}

void Subdivision::split_in_space(int cell) {
  const std::span<const int> nodes = old_.cells.at(cell);
  const CellFaces& shape = faces_of(old_.cells.kinds[cell]);
  const int centre = static_cast<int>(old_.nodes.size() + edges_.size() + faces_.size()) + cell;
  const auto face = [&](int a, int b, int c) {
    for (const CellFace& one : shape.faces)
      if (contains(one, a) && contains(one, b) && contains(one, c))
        return face_node(nodes_of(one, nodes));
    return -1;
  };
  for (const auto& [v, a, b, c] : shape.corners) {
    const int child[] = {nodes[v],
                         edge_node(nodes[v], nodes[a]),
                         face(v, a, b),
                         edge_node(nodes[v], nodes[b]),
                         edge_node(nodes[v], nodes[c]),
                         face(v, a, c),
                         centre,
                         face(v, b, c)};
    result_.cells.add(ElementKind::hexahedron, old_.cells.tags[cell], child);
  }
}

void Subdivision::split_cells() {
  const int centres = static_cast<int>(old_.nodes.size() + edges_.size() + faces_.size());
  for (int cell = 0; cell < old_.cells.size(); ++cell) {
    cell_start_.push_back(result_.cells.size());
    if (old_.dimension == 2)
      split_in_plane(old_.cells.at(cell), old_.cells.tags[cell], centres + cell, result_.cells);
    else
      split_in_space(cell);
  }
  cell_start_.push_back(result_.cells.size());
}

void Subdivision::split_facets() {
  const ElementList& facets = old_.facets;
  for (int facet = 0; facet < facets.size(); ++facet) {
    facet_start_.push_back(result_.facets.size());
    const std::span<const int> nodes = facets.at(facet);
    int centre = -1;
    if (*std::min_element(nodes.begin(), nodes.end()) < 0) {
      // of a node that no cell has
    } else if (old_.dimension == 2) {
      centre = edge_node(nodes[0], nodes[1]);
    } else {
      FaceKey key = {-1, -1, -1, -1};
      std::copy(nodes.begin(), nodes.end(), key.begin());
      centre = face_node(key);
    }
    if (centre < 0) {
      result_.facets.add(facets.kinds[facet], facets.tags[facet], nodes);
    } else if (old_.dimension == 2) {
      const int halves[2][2] = {{nodes[0], centre}, {centre, nodes[1]}};
      for (const auto& half : halves)
        result_.facets.add(ElementKind::line, facets.tags[facet], half);
    } else {
      split_in_plane(nodes, facets.tags[facet], centre, result_.facets);
    }
  }
  facet_start_.push_back(result_.facets.size());
}

void Subdivision::follow_groups() {
  for (const MeshGroup& group : old_.groups) {
    MeshGroup& after = result_.groups.emplace_back(group);
    if (group.dimension < old_.dimension - 1 || group.dimension > old_.dimension) continue;
    const auto& start = group.dimension == old_.dimension ? cell_start_ : facet_start_;
    after.members.clear();
    for (int member : group.members)
      for (int child = start[member]; child < start[member + 1]; ++child)
        after.members.push_back(child);
  }
}

ImportedMesh Subdivision::operator()() {
  for (int cell = 0; cell < old_.cells.size(); ++cell) {
    if (old_.cells.kinds[cell] == ElementKind::pyramid)
      refuse_mesh(
          old_.file,
          fmt::format(
              "element {} is a pyramid, which cannot be subdivided into hexahedra; expected "
              "hexahedra, tetrahedra or wedges (in Gmsh: no Recombine Surface between tetrahedra)",
              old_.cells.tags[cell]));
    collect(cell);
  }
  sort_once(edges_);
  sort_once(faces_);
  add_nodes();
  split_cells();
  split_facets();
  follow_groups();
  return std::move(result_);
}

}  // namespace

bool needs_subdivision(const ImportedMesh& mesh) {
  const ElementKind wanted =
      mesh.dimension == 2 ? ElementKind::quadrilateral : ElementKind::hexahedron;
  return std::any_of(mesh.cells.kinds.begin(), mesh.cells.kinds.end(),
                     [wanted](ElementKind kind) { return kind != wanted; });
}

ImportedMesh subdivide(const ImportedMesh& mesh, const EdgeBulges& bulges) {
  return Subdivision(mesh, bulges)();
}

}  // namespace gnomon
