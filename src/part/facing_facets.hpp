// Which facets of two bodies can touch each other, and which of the bodies is the slave.
#pragma once

#include <functional>
#include <gnomon/model/assembly.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon::part {

/// The body to which a facet of the boundary belongs.
template <int dim>
class BodyOfFacets {
public:
  BodyOfFacets(const Mesh<dim>& mesh, const std::vector<Body>& bodies);
  int operator()(const typename Mesh<dim>::Facet& facet) const;

private:
  std::map<typename Mesh<dim>::Facet, int> body_;  // by sorted nodes
};

/// Leaves the facets that meet one of the other side along their normals, nodes at `x`, within the
/// reach of the pair.
template <int dim>
void keep_facing(const std::vector<Vector<dim>>& x, Section section, MortarPair<dim>& pair);

/// The same for bodies in several places, nodes at each of `x`: those that meet one at any of them.
template <int dim>
void keep_facing_at(const std::vector<std::vector<Vector<dim>>>& x, Section section,
                    MortarPair<dim>& pair);

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

/// The mean size of facets, edges of them in space [length].
template <int dim>
double mean_size(const std::vector<typename Mesh<dim>::Facet>& facets,
                 const std::vector<Vector<dim>>& x);

/// Exchanges slave and master.
template <int dim>
void reverse(MortarPair<dim>& pair);

/// The slave is the side of the coarser mesh where they first touch, or where they are equal, of
/// the stiffer body: a fine slave would feel the facets of the master; but in space the side that
/// lies within the other one. Reverses the pair where it
/// has to be, and says why it is so.
template <int dim>
std::string choose_slave(const std::vector<Vector<dim>>& x, Section section,
                         const std::vector<Body>& bodies, MortarPair<dim>& pair);

}  // namespace gnomon::part
