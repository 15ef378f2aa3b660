#include "part/boundary_beside.hpp"

#include <map>
#include <set>

#include "mesh/facet_table.hpp"

namespace gnomon::part {

namespace {

/// Adds those that share a node with one that is kept, and face about the same way; again and again
/// those that are `wanted`, the others once.
template <int dim>
void keep_beside(const std::vector<typename Mesh<dim>::Facet>& facets,
                 const std::vector<Vector<dim>>& x, const std::vector<char>& wanted,
                 std::vector<char>& kept) {
  constexpr double same_way = 0.5;             // cosine
  std::map<int, std::vector<std::size_t>> at;  // by node
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const int node : facets[f]) at[node].push_back(f);
  std::vector<std::size_t> fresh;
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (kept[f]) fresh.push_back(f);
  for (bool first = true; !fresh.empty(); first = false) {
    std::vector<std::size_t> next;
    for (const std::size_t f : fresh)
      for (const int node : facets[f])
        for (const std::size_t other : at[node]) {
          if (kept[other] || (!first && !wanted[other])) continue;
          if (facet_normal<dim>(facets[f], x).dot(facet_normal<dim>(facets[other], x)) <= same_way)
            continue;
          kept[other] = 1;
          next.push_back(other);
        }
    fresh = std::move(next);
  }
}

}  // namespace

template <int dim>
void drop_across_edges(const std::vector<Vector<dim>>& x,
                       const std::vector<typename Mesh<dim>::Facet>& wearing,
                       std::vector<typename Mesh<dim>::Facet>& boundary) {
  std::set<typename Mesh<dim>::Facet> wears;  // by sorted nodes
  std::map<int, std::vector<Vector<dim>>> normals;
  for (const auto& facet : wearing) {
    wears.insert(sorted(facet));
    for (const int node : facet) normals[node].push_back(facet_normal<dim>(facet, x));
  }
  std::map<int, std::vector<std::size_t>> at;  // by node: what does not wear
  std::vector<char> kept(boundary.size(), 1);
  std::vector<std::size_t> fresh;
  for (std::size_t f = 0; f < boundary.size(); ++f) {
    if (wears.contains(sorted(boundary[f]))) continue;
    const Vector<dim> n = facet_normal<dim>(boundary[f], x);
    for (const int node : boundary[f]) {
      at[node].push_back(f);
      for (const Vector<dim>& other : normals[node])
        if (meet_at_edge<dim>(n, other)) kept[f] = 0;
    }
    if (!kept[f]) fresh.push_back(f);
  }
  while (!fresh.empty()) {  // the rest of the sides that begin there
    const std::size_t f = fresh.back();
    fresh.pop_back();
    const Vector<dim> n = facet_normal<dim>(boundary[f], x);
    for (const int node : boundary[f])
      for (const std::size_t other : at[node]) {
        if (!kept[other] || meet_at_edge<dim>(n, facet_normal<dim>(boundary[other], x))) continue;
        kept[other] = 0;
        fresh.push_back(other);
      }
  }
  leave(kept, boundary);
}

template <int dim>
void join_beside(const std::vector<Vector<dim>>& x, MortarPair<dim>& pair,
                 const std::function<bool(const typename Mesh<dim>::Facet&)>& wears) {
  for (const std::size_t side : {0u, 1u}) {
    auto& chosen = side == 0 ? pair.slave : pair.master;
    const auto& all = pair.boundary[side];
    const std::set<typename Mesh<dim>::Facet> already(chosen.begin(), chosen.end());
    std::vector<char> kept, wanted;
    for (const auto& facet : all) {
      kept.push_back(already.contains(facet));
      wanted.push_back(wears(facet));
    }
    keep_beside<dim>(all, x, wanted, kept);
    chosen = all;
    leave(kept, chosen);
  }
}

template void drop_across_edges(const std::vector<Vector<2>>&, const std::vector<Mesh<2>::Facet>&,
                                std::vector<Mesh<2>::Facet>&);
template void drop_across_edges(const std::vector<Vector<3>>&, const std::vector<Mesh<3>::Facet>&,
                                std::vector<Mesh<3>::Facet>&);
template void join_beside(const std::vector<Vector<2>>&, MortarPair<2>&,
                          const std::function<bool(const Mesh<2>::Facet&)>&);
template void join_beside(const std::vector<Vector<3>>&, MortarPair<3>&,
                          const std::function<bool(const Mesh<3>::Facet&)>&);

}  // namespace gnomon::part
