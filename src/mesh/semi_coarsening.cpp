#include <algorithm>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <limits>
#include <map>

namespace gnomon {

namespace {

using Passage = CellLayers::Passage;

/// Layers of one stack after merging.
struct MergedStack {
  std::vector<double> thickness;
  std::vector<int> place;  ///< of each place between layers: its number afterwards, -1: removed
};

MergedStack merged(const std::vector<double>& thickness, double limit) {
  MergedStack result{{}, {0}};
  for (std::size_t k = 0; k < thickness.size(); ++k) {
    double sum = thickness[k];
    if (k + 1 < thickness.size() && std::max(sum, thickness[k + 1]) < limit) {
      sum += thickness[++k];
      result.place.push_back(-1);
    }
    result.thickness.push_back(sum);
    result.place.push_back(static_cast<int>(result.thickness.size()));
  }
  return result;
}

template <int dim>
class Level {
public:
  explicit Level(const Mesh<dim>& mesh) : layers_(cell_layers(mesh)), position_(mesh.nodes) {}

  std::size_t nodes() const { return position_.size(); }
  double thinnest() const;
  /// The thickness of the thickest layer that could be merged with a neighbour, 0 if there is none.
  double thickest_pair() const;
  /// Merges pairs of layers thinner than `limit`, unless more than `most` nodes would be kept; then
  /// the result is empty.
  NodeInterpolation coarsen(double limit, double most);

private:
  using Row = std::map<int, double>;  // coarse node, weight

  bool removed(const Passage& passage) const {
    return passage.stack >= 0 && stacks_[passage.stack].place[passage.place] < 0;
  }
  const Passage* removed_passage(int node) const;
  void interpolate(int node, double weight, Row& row) const;
  int beyond(const Passage& passage, int Passage::*side) const;
  void keep(const std::vector<int>& kept);

  CellLayers layers_;
  std::vector<Vector<dim>> position_;
  // While it is coarsened:
  std::vector<MergedStack> stacks_;
  std::vector<int> number_;  // of nodes on the coarse level, -1: removed
};

template <int dim>
double Level<dim>::thinnest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& stack : layers_.thickness)
    least = std::min(least, *std::min_element(stack.begin(), stack.end()));
  return least;
}

template <int dim>
double Level<dim>::thickest_pair() const {
  double most = 0;
  for (const auto& stack : layers_.thickness)
    for (std::size_t k = 1; k < stack.size(); ++k) most = std::max({most, stack[k - 1], stack[k]});
  return most;
}

template <int dim>
const Passage* Level<dim>::removed_passage(int node) const {
  for (const Passage& passage : layers_.passages[node])
    if (removed(passage)) return &passage;
  return nullptr;
}

/// Along one grid line after the other: the next nodes on the line lie between the same layers of
/// the other stacks, and are not removed from this line.
template <int dim>
void Level<dim>::interpolate(int node, double weight, Row& row) const {
  const Passage* passage = removed_passage(node);
  if (!passage) {
    row[number_[node]] += weight;  // reached along several lines round a closed ring
    return;
  }
  const double before = (position_[node] - position_[passage->before]).norm();
  const double after = (position_[node] - position_[passage->after]).norm();
  interpolate(passage->before, weight * after / (before + after), row);
  interpolate(passage->after, weight * before / (before + after), row);
}

template <int dim>
NodeInterpolation Level<dim>::coarsen(double limit, double most) {
  stacks_.clear();
  for (const auto& stack : layers_.thickness) stacks_.push_back(merged(stack, limit));
  NodeInterpolation result;
  number_.assign(nodes(), -1);
  for (int node = 0; node < static_cast<int>(nodes()); ++node) {
    if (removed_passage(node)) continue;
    number_[node] = static_cast<int>(result.kept.size());
    result.kept.push_back(node);
  }
  if (static_cast<double>(result.kept.size()) > most) return {};
  for (int node = 0; node < static_cast<int>(nodes()); ++node) {
    Row row;
    interpolate(node, 1, row);
    result.start.push_back(static_cast<int>(result.coarse.size()));
    for (const auto& [coarse, weight] : row) {
      result.coarse.push_back(coarse);
      result.weight.push_back(weight);
    }
  }
  result.start.push_back(static_cast<int>(result.coarse.size()));
  keep(result.kept);
  return result;
}

/// The coarse number of the next node on a line that is kept.
template <int dim>
int Level<dim>::beyond(const Passage& passage, int Passage::*side) const {
  for (const Passage& next : layers_.passages[passage.*side])
    if (next.stack == passage.stack && removed(next)) return number_[next.*side];
  return number_[passage.*side];
}

template <int dim>
void Level<dim>::keep(const std::vector<int>& kept) {
  std::vector<CellLayers::Passages> passages(kept.size());
  std::vector<Vector<dim>> position;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    position.push_back(position_[kept[k]]);
    passages[k] = layers_.passages[kept[k]];
    for (Passage& passage : passages[k])
      if (passage.stack >= 0)
        passage = {passage.stack, stacks_[passage.stack].place[passage.place],
                   beyond(passage, &Passage::before), beyond(passage, &Passage::after)};
  }
  layers_.passages = std::move(passages);
  position_ = std::move(position);
  for (std::size_t s = 0; s < stacks_.size(); ++s)
    layers_.thickness[s] = std::move(stacks_[s].thickness);
}

}  // namespace

template <int dim>
std::vector<NodeInterpolation> semi_coarsening(const Mesh<dim>& mesh, const CoarseningRule& rule) {
  Level<dim> level(mesh);
  std::vector<NodeInterpolation> result;
  double limit = rule.slenderness * level.thinnest();
  for (; level.nodes() >= rule.few && level.thickest_pair() > 0 && limit > 0; limit *= 2) {
    // Where the limit merges all that there is, any coarser level is the last.
    const bool all = limit > level.thickest_pair();
    const double most = all ? double(level.nodes()) - 1 : rule.most_kept * double(level.nodes());
    NodeInterpolation next = level.coarsen(limit, most);
    if (!next.kept.empty()) result.push_back(std::move(next));
  }
  if (level.nodes() > rule.many) return {};
  return result;
}

template std::vector<NodeInterpolation> semi_coarsening(const Mesh<2>&, const CoarseningRule&);
template std::vector<NodeInterpolation> semi_coarsening(const Mesh<3>&, const CoarseningRule&);

}  // namespace gnomon
