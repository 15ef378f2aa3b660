#include "part/facing_refusal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <limits>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/bring_together.hpp"
#include "part/surfaces.hpp"

namespace gnomon::part {

namespace {

/// How far the nearest way out is for bodies that overlap, along one of the directions; 0: in one
/// of them they are apart [length].
template <int dim>
double overlap_of(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < dim; ++i)
    for (const double sign : {1.0, -1.0}) {
      const double travel = travel_to_touch<dim>(pair, sign * Vector<dim>::Unit(i), x);
      if (std::isfinite(travel)) least = std::min(least, -travel);
    }
  return std::isfinite(least) ? std::max(0.0, least) : 0;
}

/// With all boundary of both bodies, also across the edges of what wears.
template <int dim>
MortarPair<dim> with_whole_boundary(const ImportedBody<dim>& part, const BodyOfFacets<dim>& body_of,
                                    MortarPair<dim> pair) {
  pair.slave.clear();
  pair.master.clear();
  for (const auto& facet : part.exterior) {
    if (body_of(facet) == pair.numbers[0]) pair.slave.push_back(facet);
    if (body_of(facet) == pair.numbers[1]) pair.master.push_back(facet);
  }
  return pair;
}

/// Surfaces of wear.on that belong to one of the bodies and face nothing of the other one, where
/// other boundary does.
template <int dim>
std::vector<std::string> idle_surfaces(const Scene& scene, const ImportedBody<dim>& part,
                                       const BodyOfFacets<dim>& body_of, MortarPair<dim> whole,
                                       const std::vector<std::vector<Vector<dim>>>& x) {
  keep_facing_at<dim>(x, Section::plane, whole);  // of any section: areas do not matter
  if (whole.slave.empty()) return {};
  std::set<typename Mesh<dim>::Facet> facing;  // by sorted nodes
  for (const auto* side : {&whole.slave, &whole.master})
    for (const auto& facet : *side) facing.insert(sorted(facet));
  std::vector<std::string> idle;
  for (const Surface<dim>& surface : wearing_surfaces(scene, part)) {
    const auto faces = [&](const auto& facet) { return facing.contains(sorted(facet)); };
    const auto belongs = [&](const auto& facet) {
      return std::ranges::count(whole.numbers, body_of(facet)) > 0;
    };
    if (std::ranges::any_of(surface.facets, belongs) && std::ranges::none_of(surface.facets, faces))
      idle.push_back(surface.name);
  }
  return idle;
}

}  // namespace

template <int dim>
void refuse_facing(const Scene& scene, const std::string& table, const ImportedBody<dim>& part,
                   const BodyOfFacets<dim>& body_of, const MortarPair<dim>& pair,
                   const std::vector<std::vector<Vector<dim>>>& x) {
  const auto& [one, other] = pair.bodies;
  std::string reason = fmt::format("no boundary of \"{}\" faces \"{}\"", one, other);
  if (!scene.given(table + ".surfaces")) {
    const MortarPair<dim> whole = with_whole_boundary(part, body_of, pair);
    const auto idle = idle_surfaces(scene, part, body_of, whole, x);
    if (!idle.empty())
      throw InputError(fmt::format(
          "{}: expected surfaces of \"{}\" and \"{}\" that face each other, but \"{}\" {} none, "
          "and what is across the edges of a surface that wears takes no part unless "
          "{}.surfaces names what touches",
          scene.where("wear.on"), one, other, fmt::join(idle, "\", \""),
          idle.size() == 1 ? "faces" : "face", table));
    if (const double overlap = overlap_of<dim>(whole, x.front()); overlap > 0)
      reason = fmt::format(
          "\"{}\" and \"{}\" overlap by about {:.3g} mm: their meshes, or "
          "body.#.shift, have to set them apart",
          one, other, overlap);
  }
  throw InputError(fmt::format("{}: expected bodies that face each other, but {}",
                               scene.where(table + ".bodies"), reason));
}

template void refuse_facing(const Scene&, const std::string&, const ImportedBody<2>&,
                            const BodyOfFacets<2>&, const MortarPair<2>&,
                            const std::vector<std::vector<Vector<2>>>&);
template void refuse_facing(const Scene&, const std::string&, const ImportedBody<3>&,
                            const BodyOfFacets<3>&, const MortarPair<3>&,
                            const std::vector<std::vector<Vector<3>>>&);

}  // namespace gnomon::part
