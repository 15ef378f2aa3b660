#include "part/facing_facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <gnomon/terms/mortar_kernel.hpp>
#include <set>

#include "mesh/facet_table.hpp"

namespace gnomon::part {

template <int dim>
BodyOfFacets<dim>::BodyOfFacets(const Mesh<dim>& mesh, const std::vector<Body>& bodies) {
  const std::vector<int> body_of = body_of_cells(bodies, mesh.cells.size());
  const FacetTable<dim> facets(mesh);
  for (int slot = 0; slot < facets.slots(); ++slot)
    if (facets.neighbour(slot) == facets.exterior)
      body_[sorted(facets.facet(slot))] =
          body_of[static_cast<std::size_t>(slot / facets.facets_per_cell)];
}

template <int dim>
int BodyOfFacets<dim>::operator()(const typename Mesh<dim>::Facet& facet) const {
  const auto found = body_.find(sorted(facet));
  return found == body_.end() ? -1 : found->second;
}

template <int dim>
std::vector<int> body_of_nodes(const AssemblyParts<dim>& parts) {
  const std::vector<int> body_of = body_of_cells(parts.bodies, parts.mesh.cells.size());
  std::vector<int> result(parts.mesh.nodes.size(), -1);
  for (std::size_t cell = 0; cell < body_of.size(); ++cell)
    for (const int node : parts.mesh.cells[cell]) result[node] = body_of[cell];
  return result;
}

namespace {

template <int dim>
Vector<dim> normal_of(const typename Mesh<dim>::Facet& facet, const std::vector<Vector<dim>>& x) {
  if constexpr (dim == 2) {
    const Vector<2> a = x[facet[1]] - x[facet[0]];
    return Vector<2>(a[1], -a[0]).normalized();
  } else {
    return (x[facet[2]] - x[facet[0]]).cross(x[facet[3]] - x[facet[1]]).normalized();
  }
}

/// Flat, where it is now.
template <int dim>
FacetPair<dim> pair_of(const typename Mesh<dim>::Facet& slave,
                       const typename Mesh<dim>::Facet& master, const std::vector<Vector<dim>>& x) {
  FacetPair<dim> pair;
  const Vector<dim> n = normal_of<dim>(slave, x);
  for (int a = 0; a < Mesh<dim>::facet_nodes; ++a) {
    pair.x.row(a) = x[slave[a]].transpose();
    pair.n.row(a) = n.transpose();
    pair.y.row(a) = x[master[a]].transpose();
  }
  pair.X = pair.x;
  return pair;
}

/// Adds those that share a node with one that is kept, and face about the same way.
template <int dim>
void keep_beside(const std::vector<typename Mesh<dim>::Facet>& facets,
                 const std::vector<Vector<dim>>& x, std::vector<char>& kept) {
  constexpr double same_way = 0.5;             // cosine
  std::map<int, std::vector<std::size_t>> at;  // by node, of those kept
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (kept[f])
      for (const int node : facets[f]) at[node].push_back(f);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const int node : facets[f])
      if (const auto found = at.find(node); found != at.end())
        for (const std::size_t other : found->second)
          if (normal_of<dim>(facets[f], x).dot(normal_of<dim>(facets[other], x)) > same_way)
            kept[f] = 1;
}

template <class Facets>
void leave(const std::vector<char>& kept, Facets& facets) {
  std::size_t f = 0;
  std::erase_if(facets, [&](const auto&) { return !kept[f++]; });
}

}  // namespace

template <int dim>
void keep_facing(const std::vector<Vector<dim>>& x, Section section, MortarPair<dim>& pair,
                 const std::function<bool(const typename Mesh<dim>::Facet&)>& always) {
  // Facets that face away from each other are far behind each other.
  const Box<dim> box = Box<dim>::around(x);
  const double deepest = 0.01 * (box.high - box.low).norm();
  std::vector<char> slave(pair.slave.size(), 0), master(pair.master.size(), 0);
  for (std::size_t s = 0; s < slave.size(); ++s)
    for (std::size_t m = 0; m < master.size(); ++m) {
      const FacetPair<dim> both = pair_of<dim>(pair.slave[s], pair.master[m], x);
      const CoveredPart<dim> part = covered_part<dim>(both, section, pair.reach);
      if (part.mass.sum() > 0 && part.gap.sum() > -deepest * part.mass.sum())
        slave[s] = master[m] = 1;
    }
  if (always) {
    keep_beside<dim>(pair.slave, x, slave);
    keep_beside<dim>(pair.master, x, master);
    for (std::size_t s = 0; s < slave.size(); ++s) slave[s] |= always(pair.slave[s]);
    for (std::size_t m = 0; m < master.size(); ++m) master[m] |= always(pair.master[m]);
  }
  leave(slave, pair.slave);
  leave(master, pair.master);
}

template <int dim>
double mean_size(const std::vector<typename Mesh<dim>::Facet>& facets,
                 const std::vector<Vector<dim>>& x) {
  double sum = 0;
  for (const auto& facet : facets)
    for (std::size_t a = 0; a < facet.size(); ++a)
      sum += (x[facet[(a + 1) % facet.size()]] - x[facet[a]]).norm();
  return sum / static_cast<double>(facets.size() * Mesh<dim>::facet_nodes);
}

template <int dim>
void reverse(MortarPair<dim>& pair) {
  std::swap(pair.slave, pair.master);
  std::swap(pair.bodies[0], pair.bodies[1]);
  pair.approach *= -1;
  pair.motion.velocity *= -1;
  pair.motion.spin *= -1;
  pair.motion.across *= -1;
  pair.motion.across_by_x *= -1;
}

template <int dim>
std::string choose_slave(const std::vector<Vector<dim>>& x, const std::vector<Body>& bodies,
                         MortarPair<dim>& pair) {
  constexpr double equal = 1.1;
  const double slave = mean_size<dim>(pair.slave, x), master = mean_size<dim>(pair.master, x);
  const auto modulus = [&](int side) {
    return std::ranges::find(bodies, pair.bodies[side], &Body::name)->material.young_modulus;
  };
  const bool alike = std::max(slave, master) <= equal * std::min(slave, master);
  if (alike ? modulus(1) > modulus(0) : master > slave) reverse(pair);
  if (!alike)
    return fmt::format("its mesh is the coarser one there ({:.3g} and {:.3g} mm)",
                       std::max(slave, master), std::min(slave, master));
  return modulus(0) > modulus(1) ? "their meshes are alike there, and it is the stiffer body"
                                 : "their meshes and moduli are alike";
}

template class BodyOfFacets<2>;
template class BodyOfFacets<3>;
template std::vector<int> body_of_nodes(const AssemblyParts<2>&);
template std::vector<int> body_of_nodes(const AssemblyParts<3>&);
template void keep_facing(const std::vector<Vector<2>>&, Section, MortarPair<2>&,
                          const std::function<bool(const Mesh<2>::Facet&)>&);
template void keep_facing(const std::vector<Vector<3>>&, Section, MortarPair<3>&,
                          const std::function<bool(const Mesh<3>::Facet&)>&);
template double mean_size(const std::vector<Mesh<2>::Facet>&, const std::vector<Vector<2>>&);
template double mean_size(const std::vector<Mesh<3>::Facet>&, const std::vector<Vector<3>>&);
template void reverse(MortarPair<2>&);
template void reverse(MortarPair<3>&);
template std::string choose_slave(const std::vector<Vector<2>>&, const std::vector<Body>&,
                                  MortarPair<2>&);
template std::string choose_slave(const std::vector<Vector<3>>&, const std::vector<Body>&,
                                  MortarPair<3>&);

}  // namespace gnomon::part
