// Which facets of two bodies can touch each other, and which of the bodies is the slave.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <map>
#include <string>
#include <vector>

#include "model/facet_gaps.hpp"

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

/// What of the sides of a pair meets.
template <int dim>
Cover cover_of(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x, Section section);

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
