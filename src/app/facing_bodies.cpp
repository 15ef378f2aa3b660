#include "app/facing_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/terms/mortar_pair.hpp>
#include <limits>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"

namespace gnomon::app {

namespace {

template <int dim>
struct Place {
  typename Mesh<dim>::Facet facet;
  Vector<dim> centre, normal;
  double size;  ///< mean edge
};

template <int dim>
Place<dim> place_of(const typename Mesh<dim>::Facet& facet, const Mesh<dim>& mesh) {
  Place<dim> place{.facet = facet,
                   .centre = Vector<dim>::Zero(),
                   .normal = facet_normal<dim>(facet, mesh.nodes),
                   .size = 0};
  for (std::size_t a = 0; a < facet.size(); ++a) {
    const Vector<dim>& X = mesh.nodes[facet[a]];
    place.centre += X / static_cast<double>(facet.size());
    place.size +=
        (mesh.nodes[facet[(a + 1) % facet.size()]] - X).norm() / static_cast<double>(facet.size());
  }
  return place;
}

/// The distance of facets that look at each other; infinite for others.
template <int dim>
double distance_of(const Place<dim>& one, const Place<dim>& other) {
  constexpr double far = std::numeric_limits<double>::infinity();
  constexpr double opposite = -0.2;                // cosines
  constexpr double straight = 0.8, behind = -0.5;  // of near facets one may be beside the other
  if (one.normal.dot(other.normal) > opposite) return far;
  const Vector<dim> across = other.centre - one.centre;
  const double distance = across.norm();
  const double least = distance * (distance > one.size + other.size ? straight : behind);
  return across.dot(one.normal) < least || -across.dot(other.normal) < least ? far : distance;
}

/// Calls `visit` with the positions and distance of all facets that face each other within
/// `limit`, which it may make smaller. The `others` ascend in the first coordinate.
template <int dim, class Visit>
void for_each_near(const std::vector<Place<dim>>& places, const std::vector<Place<dim>>& others,
                   double& limit, const Visit& visit) {
  for (std::size_t p = 0; p < places.size(); ++p) {
    const double x = places[p].centre[0];
    const auto first = std::ranges::lower_bound(others, x - limit, {},
                                                [](const auto& place) { return place.centre[0]; });
    for (auto other = first; other != others.end() && other->centre[0] <= x + limit; ++other)
      if (const double distance = distance_of(places[p], *other);
          std::isfinite(distance) && distance <= limit)
        visit(p, static_cast<std::size_t>(other - others.begin()), distance);
  }
}

template <int dim>
class Boundary {
public:
  Boundary(const ImportedBody<dim>& body, const std::vector<std::string>& names)
      : parts_(body.mesh.boundary), places_(names.size()) {
    body_of_ = bodies_of_nodes(body, names);
    for (const auto& facet : body.exterior)
      if (const int of = body_of_[facet[0]]; of >= 0)
        places_[of].push_back(place_of<dim>(facet, body.mesh));
    for (auto& places : places_)
      std::ranges::sort(places, {}, [](const auto& place) { return place.centre[0]; });
    for (const auto& [name, facets] : body.mesh.boundary)
      for (const auto& facet : facets) names_[sorted(facet)].push_back(name);
  }

  /// Nothing, with an infinite gap, of bodies that do not face each other.
  Encounter<dim> encounter(int one, int other) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    const auto &places = places_[one], &others = places_[other];
    Encounter<dim> result{.bodies = {one, other}, .gap = far};
    double size = 0;
    for_each_near(places, others, result.gap, [&](std::size_t p, std::size_t o, double distance) {
      result.gap = distance;
      size = std::max(places[p].size, others[o].size);
    });
    if (result.gap == far) return result;
    result.touch = result.gap <= size;
    std::array<std::set<std::size_t>, 2> near;
    double limit = result.gap + size;
    for_each_near(places, others, limit, [&](std::size_t p, std::size_t o, double) {
      near[0].insert(p);
      near[1].insert(o);
    });
    for (const std::size_t side : {0u, 1u}) name_side(near[side], side, result);
    return result;
  }

private:
  const std::map<std::string, std::vector<typename Mesh<dim>::Facet>>& parts_;
  std::vector<int> body_of_;
  std::vector<std::vector<Place<dim>>> places_;                          // by body
  std::map<typename Mesh<dim>::Facet, std::vector<std::string>> names_;  // by sorted nodes

  void name_side(const std::set<std::size_t>& near, std::size_t side,
                 Encounter<dim>& result) const {
    const int of = result.bodies[side];
    std::set<std::string> parts;
    for (const std::size_t p : near) {
      const auto& facet = places_[of][p].facet;
      result.facets[side].push_back(facet);
      if (const auto found = names_.find(sorted(facet)); found != names_.end())
        parts.insert(found->second.begin(), found->second.end());
    }
    result.parts[side].assign(parts.begin(), parts.end());
    if (parts.empty()) return;
    std::map<typename Mesh<dim>::Facet, typename Mesh<dim>::Facet> facets;  // each once
    for (const std::string& part : parts)
      for (const auto& facet : parts_.at(part))
        if (body_of_[facet[0]] == of) facets.try_emplace(sorted(facet), facet);
    result.facets[side].clear();
    for (const auto& [nodes, facet] : facets) result.facets[side].push_back(facet);
  }
};

}  // namespace

template <int dim>
std::vector<int> bodies_of_nodes(const ImportedBody<dim>& body,
                                 const std::vector<std::string>& names) {
  std::vector<int> result(body.mesh.nodes.size(), -1);
  for (std::size_t of = 0; of < names.size(); ++of)
    for (const int cell : body.cell_groups.at(names[of]))
      for (const int node : body.mesh.cells[cell]) result[node] = static_cast<int>(of);
  return result;
}

template <int dim>
std::vector<Encounter<dim>> find_encounters(const ImportedBody<dim>& body,
                                            const std::vector<std::string>& names) {
  const Boundary<dim> boundary(body, names);
  std::vector<Encounter<dim>> encounters;
  for (int one = 0; one < std::ssize(names); ++one)
    for (int other = one + 1; other < std::ssize(names); ++other) {
      Encounter<dim> encounter = boundary.encounter(one, other);
      if (std::isfinite(encounter.gap)) encounters.push_back(std::move(encounter));
    }
  std::ranges::stable_sort(encounters, {}, &Encounter<dim>::gap);
  return encounters;
}

template std::vector<int> bodies_of_nodes(const ImportedBody<2>&, const std::vector<std::string>&);
template std::vector<int> bodies_of_nodes(const ImportedBody<3>&, const std::vector<std::string>&);
template std::vector<Encounter<2>> find_encounters(const ImportedBody<2>&,
                                                   const std::vector<std::string>&);
template std::vector<Encounter<3>> find_encounters(const ImportedBody<3>&,
                                                   const std::vector<std::string>&);

}  // namespace gnomon::app
