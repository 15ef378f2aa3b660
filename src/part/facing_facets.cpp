#include "part/facing_facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <numeric>
#include <set>

#include "mesh/facet_table.hpp"
#include "part/boundary_beside.hpp"

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

namespace {

/// Those of a pair that meet anywhere within its reach, and are not far behind each other, as are
/// facets that face away from each other.
template <int dim>
FacetGaps gaps_of(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x, Section section,
                  Cover* cover = nullptr) {
  const double deepest = 0.01 * Box<dim>::around(x).diagonal();
  return facet_gaps<dim>(pair.slave, pair.master, x, section,
                         {-std::min(deepest, pair.reach), pair.reach}, cover);
}

/// Mean edge of the few facets with the smallest gaps [length].
template <int dim>
double size_near_touch(const std::vector<typename Mesh<dim>::Facet>& facets,
                       const std::vector<double>& gaps, const std::vector<Vector<dim>>& x) {
  const std::size_t few = std::min<std::size_t>(dim == 2 ? 4 : 12, facets.size());
  std::vector<std::size_t> order(facets.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::partial_sort(order, order.begin() + std::ptrdiff_t(few), {},
                            [&](std::size_t f) { return gaps[f]; });
  std::vector<typename Mesh<dim>::Facet> nearest;
  for (std::size_t k = 0; k < few; ++k) nearest.push_back(facets[order[k]]);
  return mean_size<dim>(nearest, x);
}

}  // namespace

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
void keep_facing(const std::vector<Vector<dim>>& x, Section section, MortarPair<dim>& pair) {
  const auto gaps = gaps_of(pair, x, section);
  const auto meets = [](double gap) { return static_cast<char>(std::isfinite(gap)); };
  std::vector<char> slave(gaps[0].size()), master(gaps[1].size());
  std::ranges::transform(gaps[0], slave.begin(), meets);
  std::ranges::transform(gaps[1], master.begin(), meets);
  leave(slave, pair.slave);
  leave(master, pair.master);
}

template <int dim>
void keep_facing_at(const std::vector<std::vector<Vector<dim>>>& x, Section section,
                    MortarPair<dim>& pair) {
  std::array<std::set<typename Mesh<dim>::Facet>, 2> kept;
  for (const auto& at : x) {
    MortarPair<dim> there = pair;
    keep_facing<dim>(at, section, there);
    kept[0].insert(there.slave.begin(), there.slave.end());
    kept[1].insert(there.master.begin(), there.master.end());
  }
  std::erase_if(pair.slave, [&](const auto& facet) { return !kept[0].contains(facet); });
  std::erase_if(pair.master, [&](const auto& facet) { return !kept[1].contains(facet); });
}

template <int dim>
Cover cover_of(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x, Section section) {
  Cover cover;
  gaps_of(pair, x, section, &cover);
  return cover;
}

template <int dim>
void reverse(MortarPair<dim>& pair) {
  std::swap(pair.slave, pair.master);
  std::swap(pair.boundary[0], pair.boundary[1]);
  std::swap(pair.bodies[0], pair.bodies[1]);
  std::swap(pair.numbers[0], pair.numbers[1]);
  std::swap(pair.velocities[0], pair.velocities[1]);
  std::swap(pair.spins[0], pair.spins[1]);
  pair.approach *= -1;
  pair.motion = relative_motion(pair.motion, {});
}

namespace {

double area_of(const std::vector<Mesh<3>::Facet>& facets, const std::vector<Vector<3>>& x) {
  double area = 0;
  for (const auto& facet : facets)
    area += (x[facet[2]] - x[facet[0]]).cross(x[facet[3]] - x[facet[1]]).norm() / 2;
  return area;
}

/// In space, the side that lies within the other one, past whose edges this goes on; -1: none does.
/// A facet of the slave that is covered in part has multipliers that are hardly determined.
int side_within(const MortarPair<3>& pair, const std::vector<Vector<3>>& x, double covered) {
  constexpr double all = 0.98, part = 0.9;
  const double slave = covered / area_of(pair.slave, x), master = covered / area_of(pair.master, x);
  if (std::max(slave, master) < all || std::min(slave, master) > part) return -1;
  return slave > master ? 0 : 1;
}
int side_within(const MortarPair<2>&, const std::vector<Vector<2>>&, double) {
  return -1;
}

}  // namespace

template <int dim>
std::string choose_slave(const std::vector<Vector<dim>>& x, Section section,
                         const std::vector<Body>& bodies, MortarPair<dim>& pair) {
  constexpr double equal = 1.1;
  Cover cover;
  const auto gaps = gaps_of(pair, x, section, &cover);
  if (const int within = side_within(pair, x, cover.area); within >= 0) {
    if (within == 1) reverse(pair);
    return "it lies within the other surface";
  }
  const double slave = size_near_touch<dim>(pair.slave, gaps[0], x),
               master = size_near_touch<dim>(pair.master, gaps[1], x);
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
template void keep_facing(const std::vector<Vector<2>>&, Section, MortarPair<2>&);
template void keep_facing(const std::vector<Vector<3>>&, Section, MortarPair<3>&);
template void keep_facing_at(const std::vector<std::vector<Vector<2>>>&, Section, MortarPair<2>&);
template void keep_facing_at(const std::vector<std::vector<Vector<3>>>&, Section, MortarPair<3>&);
template Cover cover_of(const MortarPair<2>&, const std::vector<Vector<2>>&, Section);
template Cover cover_of(const MortarPair<3>&, const std::vector<Vector<3>>&, Section);
template double mean_size(const std::vector<Mesh<2>::Facet>&, const std::vector<Vector<2>>&);
template double mean_size(const std::vector<Mesh<3>::Facet>&, const std::vector<Vector<3>>&);
template void reverse(MortarPair<2>&);
template void reverse(MortarPair<3>&);
template std::string choose_slave(const std::vector<Vector<2>>&, Section, const std::vector<Body>&,
                                  MortarPair<2>&);
template std::string choose_slave(const std::vector<Vector<3>>&, Section, const std::vector<Body>&,
                                  MortarPair<3>&);

}  // namespace gnomon::part
