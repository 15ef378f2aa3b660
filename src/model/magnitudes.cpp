#include <algorithm>
#include <cmath>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/expected_contact.hpp"
#include "model/gap_profile.hpp"

namespace gnomon {

namespace {

template <int dim>
using Patches = std::vector<ContactPatch<dim>>;

/// Of the contact nodes that something can meet.
template <int dim>
GapProfile gaps_of(const AssemblyParts<dim>& parts, const Patches<dim>& patches) {
  const std::map<int, double> least = gaps_over_cycle(parts);
  std::vector<double> gaps, areas;
  for (const ContactPatch<dim>& patch : patches)
    if (const auto at = least.find(patch.node); at != least.end()) {
      gaps.push_back(at->second);
      areas.push_back(patch.initial_area);
    }
  return {gaps, areas};
}

/// Of the softest body, or of the two softest against each other.
double contact_modulus(const std::vector<Body>& bodies, bool pairs) {
  std::vector<double> compliances;
  for (const Body& body : bodies) {
    const double nu = body.material.poisson_ratio;
    compliances.push_back((1 - nu * nu) / body.material.young_modulus);
  }
  std::ranges::sort(compliances, std::greater());
  return 1 / (compliances[0] + (pairs && compliances.size() > 1 ? compliances[1] : 0));
}

/// `rate`: of the volume, by force and length of the path. In the plane it is that of the depth; in
/// space a groove gets wider.
template <int dim>
double depth_of_tracks(double rate, const Pressing& press, const Indentation& start,
                       const GapProfile& gaps, double duration) {
  if (rate == 0) return 0;
  const bool loaded = press.force > 0;
  const double section = rate * (loaded ? press.impulse : start.force * duration),
               most = loaded ? std::numeric_limits<double>::infinity() : press.overlap;
  if (dim == 2) return std::min(section, most);
  const double width = width_of(start.area, true);
  return std::min({section / width, gaps.depth_of(section * width), most});
}

/// About how far a line load moves bodies that are large beside its width, at most: more than the
/// contact alone, by a logarithm (K. L. Johnson, Contact Mechanics, sec. 5.6) [length].
template <int dim>
double sinking_of_line(const AssemblyParts<dim>& parts, const Indentation& at, double modulus) {
  const auto [low, high] = Box<dim>::around(parts.mesh.nodes);
  return 2 * at.force / modulus * std::log(std::max(1.0, 4 * (high - low).norm() / at.area));
}

/// The smallest of the bodies that wear, along the approach [length].
template <int dim>
double size_of_wearing(const AssemblyParts<dim>& parts) {
  std::set<int> worn;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    if (surface.wears) worn.merge(nodes_of_facets(surface.facets));
  const auto size = [&](const std::set<int>& nodes) {
    std::vector<Vector<dim>> x;
    for (const int node : nodes) x.push_back(parts.mesh.nodes[static_cast<std::size_t>(node)]);
    const auto [low, high] = Box<dim>::around(x);
    return (high - low).dot(parts.interface.partner.approach.cwiseAbs());
  };
  double least = std::numeric_limits<double>::infinity();
  const std::vector<int> body_of = body_of_cells(parts.bodies, parts.mesh.cells.size());
  for (int body = 0; body < static_cast<int>(parts.bodies.size()); ++body) {
    std::set<int> nodes;
    bool wears = false;
    for (std::size_t cell = 0; cell < body_of.size(); ++cell) {
      if (body_of[cell] != body) continue;
      const auto& corners = parts.mesh.cells[cell];
      nodes.insert(corners.begin(), corners.end());
      wears = wears || std::ranges::count_if(corners, [&](int node) {
                         return worn.contains(node);
                       }) >= Mesh<dim>::facet_nodes;
    }
    if (wears) least = std::min(least, size(nodes));
  }
  return least;
}

/// The initial positions of nodes of a surface.
template <int dim>
std::vector<std::array<double, 3>> places_on(const Surface<dim>& surface,
                                             const AssemblyParts<dim>& parts) {
  std::vector<std::array<double, 3>> places(surface.facets.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    std::ranges::copy(parts.mesh.nodes[static_cast<std::size_t>(surface.facets[k].front())],
                      places[k].begin());
  return places;
}

/// Of the wearing surfaces together, by force and time: where they touch a volume, of pairs that of
/// the two that wear most, since both recede; of tracks a volume by length of the path.
struct Recession {
  double local = 0, track = 0;
};

/// `by_surface`: Wdot / p of each.
template <int dim>
Recession recession(const AssemblyParts<dim>& parts, const std::vector<double>& by_surface) {
  Recession sum;
  double second = 0;
  for (std::size_t s = 0; s < by_surface.size(); ++s) {
    const Surface<dim>& surface = parts.interface.surfaces[s];
    if (surface.track) {
      sum.track += by_surface[s] / surface.track->path;
      continue;
    }
    second = std::max(second, std::min(by_surface[s], sum.local));
    sum.local = std::max(sum.local, by_surface[s]);
  }
  if (!parts.pairs.empty()) sum.local += second;
  return sum;
}

/// Where laws read the depth, what each surface wears by it. `nominal`: depths at rates of new
/// surfaces, those of `fresh` [length].
template <int dim, class Circumstances>
void follow_laws(const AssemblyParts<dim>& parts, const Circumstances& circumstances,
                 const Recession& fresh, const Recession& nominal,
                 std::vector<double>& by_surface) {
  for (std::size_t s = 0; s < by_surface.size(); ++s) {
    const Surface<dim>& surface = parts.interface.surfaces[s];
    const double own = surface.track
                           ? nominal.track * by_surface[s] / surface.track->path / fresh.track
                           : nominal.local * by_surface[s] / fresh.local;
    if (by_surface[s] > 0 && own > 0)
      by_surface[s] *= depth_by_law(surface.wear, circumstances(surface), own) / own;
  }
}

}  // namespace

template <int dim>
Magnitudes magnitudes_of(const AssemblyParts<dim>& parts, double duration) {
  const Pressing press = pressing_of(parts, duration);
  const Patches<dim> patches = contact_nodes_of(parts);
  const double modulus = contact_modulus(parts.bodies, !parts.pairs.empty());
  const GapProfile gaps = gaps_of(parts, patches);
  const bool solid = dim == 3 || parts.section() == Section::meridian;
  Indentation start = press.force > 0 ? by_force(gaps, press.force, modulus, solid)
                                      : by_overlap(gaps, press.overlap, modulus, solid);
  if (press.force == 0 && press.springs > 0 && press.springs < start.force)
    start = by_force(gaps, press.springs, modulus, solid);
  Magnitudes result;
  Scales& scales = result.scales;
  scales.duration = duration;
  scales.force = start.force;
  scales.displacement =
      solid ? start.depth : std::max(start.depth, sinking_of_line(parts, start, modulus));
  const auto circumstances = [&](const Surface<dim>& surface) {
    return WearCircumstances{.pressure = start.force / start.area,
                             .friction = parts.interface.friction,
                             .speed = parts.nominal_speed(),
                             .duration = duration,
                             .initial = places_on(surface, parts)};
  };
  std::vector<double> by_surface;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    by_surface.push_back(surface.wears ? wear_by_pressure(surface.wear, circumstances(surface))
                                       : 0.0);
  const Recession fresh = recession(parts, by_surface);
  // Held bodies wear until they no longer overlap.
  const double worn = press.force > 0 ? fresh.local * press.impulse
                                      : std::min(fresh.local * start.force * duration,
                                                 gaps.volume(press.overlap)),
               local = worn > 0 ? gaps.depth_of(worn) : 0,
               track = depth_of_tracks<dim>(fresh.track, press, start, gaps, duration);
  follow_laws<dim>(parts, circumstances, fresh, {local, track}, by_surface);
  const Recession later = recession(parts, by_surface);
  const double of_local = fresh.local > 0 ? later.local / fresh.local : 1,
               of_track = fresh.track > 0 ? later.track / fresh.track : 1;
  result.deepest = of_local * local + of_track * track;
  // In the plane a track recedes as a whole, and does not widen the contact.
  const auto area_at = [&](double local, double track) {
    return std::max(gaps.area(dim == 2 ? local : local + track), start.area);
  };
  const double shaping = dim == 2 ? of_local * local : result.deepest,
               worn_area = area_at(of_local * local, of_track * track);
  scales.stress = start.force / worn_area;
  scales.wear_depth = result.deepest > 0
                          ? of_local * (worn / area_at(local, track)) + of_track * track
                          : scales.displacement;
  const double half_width = solid ? std::sqrt(worn_area / M_PI) : worn_area / 2;
  // What lies flat on each other recedes as a whole.
  result.slope = 2 * std::min(shaping, gaps.largest()) / half_width;
  result.thinning = result.deepest / size_of_wearing(parts);
  double area = 0, count = 0;
  for (const auto& patch : patches) area += patch.initial_area, ++count;
  result.facet = width_of(area / count, solid);
  result.strain = start.force / (start.area * modulus);
  result.contact_nodes = std::max(gaps.count(start.depth), gaps.count(0));
  scales.auxiliary_force =
      parts.shape.law.material.young_modulus * scales.wear_depth * (dim == 2 ? 1 : result.facet);
  return result;
}

template Magnitudes magnitudes_of(const AssemblyParts<2>&, double);
template Magnitudes magnitudes_of(const AssemblyParts<3>&, double);

}  // namespace gnomon
