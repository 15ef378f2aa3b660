#include <algorithm>
#include <limits>

#include "mesh/import_cells.hpp"

namespace gnomon {

namespace {

using Facet = Mesh<2>::Facet;

/// The boundary of a plane body, facet by facet along each of its closed curves.
class BoundaryOrder {
public:
  BoundaryOrder(const ImportedBody<2>& body, const std::vector<std::string>& first)
      : body_(body), facet_at_(body.mesh.nodes.size(), -1), parts_of_(body.exterior.size()) {
    for (std::size_t facet = 0; facet < body.exterior.size(); ++facet)
      facet_at_[body.exterior[facet][0]] = static_cast<int>(facet);
    int part = 0;
    for (const auto& [name, facets] : body.mesh.boundary) {
      for (const Facet& facet : facets) parts_of_[facet_at_[facet[0]]].push_back(part);
      weight_.push_back(std::find(first.begin(), first.end(), name) == first.end() ? 1 : 1000);
      ++part;
    }
  }

  std::vector<int> operator()() const {
    std::vector<int> order;
    std::vector<char> seen(body_.exterior.size(), 0);
    for (int seed = 0; seed < static_cast<int>(seen.size()); ++seed) {
      if (seen[seed]) continue;
      std::vector<int> loop;
      for (int facet = seed; !seen[facet]; facet = facet_at_[body_.exterior[facet][1]]) {
        seen[facet] = 1;
        loop.push_back(facet);
      }
      std::rotate(loop.begin(), loop.begin() + begin_of(loop), loop.end());
      order.insert(order.end(), loop.begin(), loop.end());
    }
    return order;
  }

private:
  /// Where the numbers of as few parts as possible cease to ascend. They do in each part that the
  /// facet before belongs to, whose last node is the first of all; and worse where a part goes on.
  std::ptrdiff_t begin_of(const std::vector<int>& loop) const {
    std::ptrdiff_t best = 0;
    long least = std::numeric_limits<long>::max();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto& before = parts_of_[loop[(k + loop.size() - 1) % loop.size()]];
      const auto& here = parts_of_[loop[k]];
      long cost = 0;
      for (int part : before)
        cost += weight_[part] * (std::find(here.begin(), here.end(), part) == here.end() ? 1 : 2);
      if (cost >= least) continue;
      least = cost;
      best = static_cast<std::ptrdiff_t>(k);
    }
    return best;
  }

  const ImportedBody<2>& body_;
  std::vector<int> facet_at_;               // that begins at each node
  std::vector<long> weight_;                // of each part
  std::vector<std::vector<int>> parts_of_;  // of each facet, ascending
};

/// New numbers of all nodes: those that begin a facet in its order, then the others.
std::vector<int> numbers_along(const std::vector<Facet>& exterior, std::size_t nodes) {
  std::vector<int> now(nodes, -1);
  int next = 0;
  for (const Facet& facet : exterior) now[facet[0]] = next++;
  for (int& number : now)
    if (number < 0) number = next++;
  return now;
}

template <class T>
std::vector<T> moved(const std::vector<T>& old, const std::vector<int>& now) {
  std::vector<T> result(old.size());
  for (std::size_t k = 0; k < old.size(); ++k) result[now[k]] = old[k];
  return result;
}

}  // namespace

void order_along_boundary(ImportedBody<2>& body, const std::vector<std::string>& first) {
  std::vector<Facet> ordered;
  for (int facet : BoundaryOrder(body, first)()) ordered.push_back(body.exterior[facet]);
  body.exterior = std::move(ordered);
  const std::vector<int> now = numbers_along(body.exterior, body.mesh.nodes.size());
  body.mesh.nodes = moved(body.mesh.nodes, now);
  body.node_tags = moved(body.node_tags, now);
  const auto renumber = [&now](auto& element) {
    for (int& node : element) node = now[node];
  };
  for (auto& cell : body.mesh.cells) renumber(cell);
  for (Facet& facet : body.exterior) renumber(facet);
  for (RoundFacet& facet : body.round) renumber(facet.nodes);
  for (auto& [name, facets] : body.mesh.boundary) {
    for (Facet& facet : facets) renumber(facet);
    std::sort(facets.begin(), facets.end());  // a facet begins with its number along the boundary
  }
  for (auto& [name, nodes] : body.point_groups) {
    renumber(nodes);
    std::sort(nodes.begin(), nodes.end());
  }
}

}  // namespace gnomon
