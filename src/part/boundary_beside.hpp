// Which boundary joins the facets beside it, and which is across an edge.
#pragma once

#include <functional>
#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon::part {

/// Leaves the facets that are kept.
template <class Facets>
void leave(const std::vector<char>& kept, Facets& facets) {
  std::size_t f = 0;
  std::erase_if(facets, [&](const auto&) { return !kept[f++]; });
}

/// Whether facets with these normals, unit, that share a node meet at an edge, of 15 degrees or
/// more: rounded edges turn by less from facet to facet.
template <int dim>
bool meet_at_edge(const Vector<dim>& one, const Vector<dim>& other) {
  constexpr double edge = 0.966;  // cosine
  return one.dot(other) < edge;
}

/// Drops the sides of a boundary that do not wear and join what does across an edge: nodes of a
/// wearing surface have normals of its own. What is beyond a further edge stays.
template <int dim>
void drop_across_edges(const std::vector<Vector<dim>>& x,
                       const std::vector<typename Mesh<dim>::Facet>& wearing,
                       std::vector<typename Mesh<dim>::Facet>& boundary);

/// Adds facets of the boundary beside them that face about the same way: one at each end, and all
/// that wear and go on from there.
template <int dim>
void join_beside(const std::vector<Vector<dim>>& x, MortarPair<dim>& pair,
                 const std::function<bool(const typename Mesh<dim>::Facet&)>& wears);

}  // namespace gnomon::part
