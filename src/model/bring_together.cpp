#include "model/bring_together.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "mesh/crossing.hpp"
#include "mesh/facet_bins.hpp"
#include "model/connected_parts.hpp"
#include "model/facet_gaps.hpp"

namespace gnomon {

namespace {

/// The facets that face along e.
template <int dim>
std::vector<typename Mesh<dim>::Facet> facing_along(
    const Vector<dim>& e, const std::vector<typename Mesh<dim>::Facet>& facets,
    const std::vector<Vector<dim>>& x) {
  constexpr double oblique = 1e-6;
  std::vector<typename Mesh<dim>::Facet> result;
  for (const auto& facet : facets)
    if (facet_normal<dim>(facet, x).dot(e) > oblique) result.push_back(facet);
  return result;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// By node of facets that face along e: the least travel along it to facets that face it.
template <int dim>
std::map<int, double> travels(const std::vector<typename Mesh<dim>::Facet>& from,
                              const std::vector<typename Mesh<dim>::Facet>& to,
                              const Vector<dim>& e, const std::vector<Vector<dim>>& x) {
  constexpr double rounding = 1e-9;
  std::map<int, double> travel;
  const auto targets = facing_along<dim>(-e, to, x);
  const FacetBins<dim> bins(targets, x);
  for (const auto& facet : facing_along<dim>(e, from, x))
    for (const int node : facet) {
      const auto [at, is_new] = travel.try_emplace(node, infinity);
      if (!is_new) continue;
      for (const int target : bins.near_line(x[node], e, infinity, 0))
        for (const auto& simplex : simplices<dim>(targets[target])) {
          const Crossing<dim> crossing(x[node], e, simplex, x);
          if (crossing.shares.minCoeff() >= -rounding)
            at->second = std::min(at->second, crossing.distance);
        }
    }
  return travel;
}

}  // namespace

namespace {

/// The part of e along which supports let a connected part of the mesh move. Springs do not keep it
/// from what it touches: a load may press it there from afar.
template <int dim>
Vector<dim> free_part(const AssemblyParts<dim>& parts, const std::vector<int>& part, int own,
                      Vector<dim> e) {
  if (parts.section() == Section::meridian) e[0] = 0;  // a ring has no other rigid motion
  for (std::size_t node = 0; node < part.size(); ++node)
    for (int i = 0; i < dim && part[node] == own; ++i)
      if (parts.supports.held(static_cast<Eigen::Index>(node), i)) e[i] = 0;
  return e;
}

}  // namespace

template <int dim>
double travel_to_touch(const MortarPair<dim>& pair, const Vector<dim>& e,
                       const std::vector<Vector<dim>>& x) {
  double least = infinity;
  for (const auto& travel :
       {travels<dim>(pair.slave, pair.master, -e, x), travels<dim>(pair.master, pair.slave, e, x)})
    for (const auto& [node, s] : travel) least = std::min(least, s);
  return least;
}

template <int dim>
std::map<int, double> travels_of_side(const MortarPair<dim>& pair, int side,
                                      const std::vector<Vector<dim>>& x) {
  return side == 0 ? travels<dim>(pair.slave, pair.master, -pair.approach, x)
                   : travels<dim>(pair.master, pair.slave, pair.approach, x);
}

template <int dim>
Touching<dim>::Touching(const AssemblyParts<dim>& parts, const std::vector<BodyPlace<dim>>& places)
    : displacement(NodalField<dim>::Zero(static_cast<Eigen::Index>(parts.mesh.nodes.size()), dim)),
      direction(displacement) {
  // Cosine; cones of revolution slide into each other however steep they are.
  const double slanted = parts.section() == Section::meridian ? 0.05 : 0.5;
  const std::vector<int> part = connected_parts(parts.mesh);
  std::map<int, Vector<dim>> pressed;  // of parts that have come: how, in space
  std::vector<Vector<dim>> x = in_space(parts.pairs, places, parts.mesh.nodes);
  for (bool moved = true; moved;) {
    moved = false;
    std::optional<int> wedged;
    for (const MortarPair<dim>& pair : parts.pairs) {
      const PairPlaces<dim> place(pair, places);
      const std::array<int, 2> numbers = {part[pair.slave.front()[0]],
                                          part[pair.master.front()[0]]};
      if (numbers[0] == numbers[1]) continue;  // surfaces of one body
      std::array<Vector<dim>, 2> along;        // of each side, in its frame, towards the other
      for (const std::size_t side : {0, 1}) {
        const Vector<dim> e = place.of[side].turn.transpose() * pair.approach;
        along[side] = free_part<dim>(parts, part, numbers[side], side == 0 ? Vector<dim>(-e) : e);
      }
      const auto stays = [&](std::size_t side) {
        return pressed.contains(numbers[side]) || along[side].norm() < slanted;
      };
      if (stays(0) == stays(1)) continue;
      const std::size_t side = stays(0);
      along[side].normalize();
      const Vector<dim> in_space = place.of[side].turn * along[side];
      const auto travel_along = [&](const Vector<dim>& way, Cover* cover = nullptr) {
        double least = infinity;
        for (const MortarPair<dim>& other : parts.pairs) {
          const int slave = part[other.slave.front()[0]], master = part[other.master.front()[0]];
          if (std::minmax(slave, master) != std::minmax(numbers[0], numbers[1])) continue;
          const bool is_slave = slave == numbers[side];
          const double own = travel_to_touch<dim>(other, is_slave ? -way : way, x);
          if (cover && own < 0)
            facet_gaps<dim>(other.slave, other.master, x, parts.section(), {own, -own}, cover);
          least = std::min(least, own);
        }
        return least;
      };
      const double travel = travel_along(in_space);
      if (!std::isfinite(travel)) continue;
      // As a shaft that was pressed into a hub: away from one side it is deeper in the other, and
      // not by chords of round surfaces alone.
      if (Cover cover; travel < 0 && travel_along(-in_space, &cover) < 0 && cover.volume < 0) {
        wedged = numbers[side];
        continue;
      }
      // Farther than what it rests on: both would go the same way without pressing on each other.
      const auto rest = pressed.find(numbers[1 - side]);
      const double far =
          1 + (rest == pressed.end() ? 0.0 : std::max(0.0, rest->second.dot(in_space)));
      pressed.emplace(numbers[side], far * in_space);
      for (std::size_t node = 0; node < part.size(); ++node) {
        if (part[node] != numbers[side]) continue;
        x[node] += travel * in_space;
        const auto row = static_cast<Eigen::Index>(node);
        displacement.row(row) = travel * along[side].transpose();
        direction.row(row) = far * along[side].transpose();
      }
      moved = true;
    }
    // What no other body moves stays, and others may come to it.
    if (!moved && wedged) moved = pressed.emplace(*wedged, Vector<dim>::Zero()).second;
  }
}

template double travel_to_touch(const MortarPair<2>&, const Vector<2>&,
                                const std::vector<Vector<2>>&);
template double travel_to_touch(const MortarPair<3>&, const Vector<3>&,
                                const std::vector<Vector<3>>&);
template std::map<int, double> travels_of_side(const MortarPair<2>&, int,
                                               const std::vector<Vector<2>>&);
template std::map<int, double> travels_of_side(const MortarPair<3>&, int,
                                               const std::vector<Vector<3>>&);
template struct Touching<2>;
template struct Touching<3>;

}  // namespace gnomon
