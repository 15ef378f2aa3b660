#include <algorithm>
#include <gnomon/mesh/semi_coarsening.hpp>

namespace gnomon {

namespace {

/// Corners of the edges along each axis of a cell, VTK order; a quadrilateral has the first two of
/// the first two axes.
constexpr int edges_along[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}},
                                      {{0, 3}, {1, 2}, {4, 7}, {5, 6}},
                                      {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// The edges of a mesh; the end 0 of an edge is the node with the lesser number.
class Edges {
public:
  explicit Edges(std::size_t nodes) : at_(nodes) {}

  int add(int a, int b) {
    auto& here = at_[std::min(a, b)];
    for (const auto& [other, edge] : here)
      if (other == std::max(a, b)) return edge;
    here.push_back({std::max(a, b), static_cast<int>(ends_.size())});
    ends_.push_back({std::min(a, b), std::max(a, b)});
    return static_cast<int>(ends_.size()) - 1;
  }
  const std::vector<std::array<int, 2>>& ends() const { return ends_; }

private:
  std::vector<std::array<int, 2>> ends_;
  std::vector<std::vector<std::array<int, 2>>> at_;  // by the lesser node: the other, the edge
};

/// Edges joined into layers, each with its direction relative to the others: a forest of union and
/// find whose links tell whether two edges point in opposite directions.
class Joined {
public:
  struct Link {
    int root;
    bool opposite;
  };

  explicit Joined(std::size_t edges) : two_sided_(edges, 1) {
    for (std::size_t e = 0; e < edges; ++e) link_.push_back({static_cast<int>(e), false});
  }

  Link find(int edge) {
    Link here{edge, false};
    while (link_[here.root].root != here.root) {
      Link& up = link_[here.root];
      const Link top = link_[up.root];
      up = {top.root, up.opposite != top.opposite};
      here = {up.root, here.opposite != up.opposite};
    }
    return here;
  }

  void join(int a, int b, bool opposite) {
    const Link x = find(a), y = find(b);
    const bool turn = (x.opposite != y.opposite) != opposite;
    if (x.root != y.root) {
      link_[x.root] = {y.root, turn};
      if (!two_sided_[x.root]) two_sided_[y.root] = 0;
    } else if (turn) {
      two_sided_[x.root] = 0;
    }
  }

  /// Whether the edges joined to a root have a common direction; not so round a Moebius strip.
  bool two_sided(int root) const { return two_sided_[root]; }

private:
  std::vector<Link> link_;
  std::vector<char> two_sided_;  // of a root
};

/// A side of a layer: 0 or 1.
struct Side {
  int layer = -1, side = 0;
};

template <int dim>
class LayerSearch {
public:
  explicit LayerSearch(const Mesh<dim>& mesh) : mesh_(mesh) {
    find_layers();
    find_incidences();
    find_neighbours();
  }
  CellLayers result();

private:
  /// An edge at a node, which lies on `side` of the layer of the edge.
  struct Incidence {
    int layer, side, other;
  };

  void find_layers();
  void find_incidences();
  void find_neighbours();
  const Incidence* find(int node, int layer) const;
  bool same_nodes(Side a, Side b) const;
  double thickness(int layer) const;
  void add_stack(Side lower, CellLayers& result);
  void add_passages(Side upper, Side next, int place, CellLayers& result) const;

  const Mesh<dim>& mesh_;
  std::vector<std::vector<std::array<int, 2>>> edges_;  // of each layer: nodes on sides 0 and 1
  std::vector<char> sound_;                             // of each layer
  std::vector<std::vector<Incidence>> at_;              // of each node
  std::vector<std::array<Side, 2>> neighbour_;          // of each layer, beyond sides 0 and 1
  std::vector<char> stacked_;                           // of each layer
};

template <int dim>
void LayerSearch<dim>::find_layers() {
  constexpr int of_axis = 1 << (dim - 1);
  Edges edges(mesh_.nodes.size());
  struct Turned {
    int edge;
    bool turned;
  };
  std::vector<Turned> of_cells;
  for (const auto& cell : mesh_.cells)
    for (int axis = 0; axis < dim; ++axis)
      for (int k = 0; k < of_axis; ++k) {
        const int a = cell[edges_along[axis][k][0]], b = cell[edges_along[axis][k][1]];
        of_cells.push_back({edges.add(a, b), a > b});
      }
  Joined joined(edges.ends().size());
  for (std::size_t first = 0; first < of_cells.size(); first += of_axis)
    for (int k = 1; k < of_axis; ++k) {
      const Turned &a = of_cells[first], &b = of_cells[first + k];
      joined.join(a.edge, b.edge, a.turned != b.turned);
    }
  std::vector<int> layer_of(edges.ends().size(), -1);
  for (std::size_t e = 0; e < edges.ends().size(); ++e) {
    const auto [root, opposite] = joined.find(static_cast<int>(e));
    if (layer_of[root] < 0) {
      layer_of[root] = static_cast<int>(edges_.size());
      edges_.emplace_back();
      sound_.push_back(joined.two_sided(root));
    }
    const auto& [a, b] = edges.ends()[e];
    edges_[layer_of[root]].push_back(opposite ? std::array{b, a} : std::array{a, b});
  }
}

/// A layer with two edges at a node touches itself.
template <int dim>
void LayerSearch<dim>::find_incidences() {
  at_.resize(mesh_.nodes.size());
  for (std::size_t layer = 0; layer < edges_.size(); ++layer)
    for (const auto& ends : edges_[layer])
      for (int side : {0, 1}) {
        if (find(ends[side], static_cast<int>(layer))) sound_[layer] = 0;
        at_[ends[side]].push_back({static_cast<int>(layer), side, ends[1 - side]});
      }
}

template <int dim>
const typename LayerSearch<dim>::Incidence* LayerSearch<dim>::find(int node, int layer) const {
  for (const Incidence& incidence : at_[node])
    if (incidence.layer == layer) return &incidence;
  return nullptr;
}

/// Of sound layers.
template <int dim>
bool LayerSearch<dim>::same_nodes(Side a, Side b) const {
  if (edges_[a.layer].size() != edges_[b.layer].size()) return false;
  return std::all_of(edges_[a.layer].begin(), edges_[a.layer].end(), [&](const auto& ends) {
    const Incidence* other = find(ends[a.side], b.layer);
    return other && other->side == b.side;
  });
}

template <int dim>
void LayerSearch<dim>::find_neighbours() {
  neighbour_.resize(edges_.size());
  for (int layer = 0; layer < static_cast<int>(edges_.size()); ++layer)
    for (int side : {0, 1}) {
      if (!sound_[layer]) continue;
      int found = 0;
      for (const Incidence& candidate : at_[edges_[layer].front()[side]]) {
        const Side other{candidate.layer, candidate.side};
        if (other.layer == layer || !sound_[other.layer] || !same_nodes({layer, side}, other))
          continue;
        neighbour_[layer][side] = ++found == 1 ? other : Side{};
      }
    }
}

template <int dim>
double LayerSearch<dim>::thickness(int layer) const {
  double sum = 0;
  for (const auto& [a, b] : edges_[layer]) sum += (mesh_.nodes[a] - mesh_.nodes[b]).norm();
  return sum / static_cast<double>(edges_[layer].size());
}

template <int dim>
void LayerSearch<dim>::add_passages(Side upper, Side next, int place, CellLayers& result) const {
  const int stack = static_cast<int>(result.thickness.size()) - 1;
  for (const auto& ends : edges_[upper.layer]) {
    const int node = ends[upper.side];
    for (CellLayers::Passage& passage : result.passages[node]) {
      if (passage.stack >= 0) continue;
      passage = {stack, place, ends[1 - upper.side], find(node, next.layer)->other};
      break;
    }
  }
}

/// Upwards from a layer and its lower side.
template <int dim>
void LayerSearch<dim>::add_stack(Side lower, CellLayers& result) {
  auto& layers = result.thickness.emplace_back();
  for (;;) {
    stacked_[lower.layer] = 1;
    layers.push_back(thickness(lower.layer));
    const Side upper{lower.layer, 1 - lower.side}, next = neighbour_[upper.layer][upper.side];
    if (next.layer < 0 || stacked_[next.layer]) return;
    add_passages(upper, next, static_cast<int>(layers.size()), result);
    lower = next;
  }
}

template <int dim>
CellLayers LayerSearch<dim>::result() {
  CellLayers result;
  result.passages.resize(mesh_.nodes.size());
  stacked_.assign(edges_.size(), 0);
  const int layers = static_cast<int>(edges_.size());
  for (int layer = 0; layer < layers; ++layer)
    for (int side : {0, 1})
      if (!stacked_[layer] && neighbour_[layer][side].layer < 0) add_stack({layer, side}, result);
  for (int layer = 0; layer < layers; ++layer)  // of closed rings
    if (!stacked_[layer]) add_stack({layer, 0}, result);
  return result;
}

}  // namespace

template <int dim>
CellLayers cell_layers(const Mesh<dim>& mesh) {
  return LayerSearch<dim>(mesh).result();
}

template CellLayers cell_layers(const Mesh<2>&);
template CellLayers cell_layers(const Mesh<3>&);

}  // namespace gnomon
