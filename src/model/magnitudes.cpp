#include <algorithm>
#include <cmath>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/bring_together.hpp"
#include "model/expected_contact.hpp"
#include "model/gap_profile.hpp"
#include "model/rigid_parts.hpp"

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

template <int dim>
Vector<dim> resultant(const Load<dim>& load, const AssemblyParts<dim>& parts) {
  return forces_of(load, parts).colwise().sum().transpose();
}

/// All loads together along the approach of the counter-body, at factor one, or, where they cancel
/// each other then, the largest of their history; of pairs that loads press from both sides, half
/// of the sum of their sizes.
template <int dim>
double load_along_approach(const AssemblyParts<dim>& parts) {
  constexpr double rounding = 1e-12;
  std::vector<double> along;
  for (const Load<dim>& load : parts.loads)
    along.push_back(resultant(load, parts).dot(parts.interface.partner.approach));
  const auto sum = [&](auto factor) {
    double net = 0, whole = 0;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const double force = factor(parts.loads[k].history) * along[k];
      net += force;
      whole += std::abs(force);
    }
    if (std::abs(net) > rounding * whole) return std::abs(net);
    return parts.pairs.empty() ? 0 : whole / 2;
  };
  double most = sum([](const LoadHistory&) { return 1.0; });
  if (most > 0) return most;
  for (const Load<dim>& load : parts.loads)
    for (const double t : load.history.times())
      most = std::max(most, sum([t](const LoadHistory& history) { return history.factor(t); }));
  return most;
}

/// All loads, without regard to their directions, of pairs with a body that may turn: those across
/// the approach press by their torques. Their levers are not known here.
template <int dim>
double load_on_levers(const AssemblyParts<dim>& parts) {
  constexpr double rounding = 1e-6;
  if (parts.pairs.empty()) return 0;
  const bool turns =
      std::ranges::any_of(rigid_parts(parts, parts.mesh.nodes), [](const RigidPart<dim>& part) {
        return part.loose.bottomRows(rigid_motions_of(dim) - dim).norm() > rounding;
      });
  double whole = 0;
  for (const Load<dim>& load : parts.loads)
    whole += load.forces.size() > 0
                 ? load.forces.rowwise().norm().sum()  // a moment has no resultant
                 : resultant(load, parts).norm();
  return turns ? whole : 0;
}

/// Of all springs whose other ends move, at most: of unlike directions more than there is.
template <int dim>
double force_of_springs(const AssemblyParts<dim>& parts) {
  double sum = 0;
  for (const SpringSupport<dim>& springs : parts.supports.springs) {
    const double traction =
        springs.stiffness.cwiseProduct(springs.displacement).norm() * springs.history.largest();
    for (const auto& patch : contact_patches<dim>(parts.mesh, springs.facets, {}, parts.section()))
      sum += traction * patch.initial_area;
  }
  return sum;
}

/// How far the bodies are brought into each other where no force presses them.
template <int dim>
double given_overlap(const AssemblyParts<dim>& parts) {
  double most = 0;
  const auto take = [&](const LoadHistory& history, double value) {
    most = std::max(most, std::abs(value) * history.largest());
  };
  for (const PrescribedValues& held : parts.supports.moved)
    for (const auto& entry : held.entries) take(held.history, entry.value);
  for (const Guide<dim>& guide : parts.interface.partner.guides)
    if (guide.travel) take(*guide.travel, 1);
  if (!parts.pairs.empty()) {
    for (const Phase<dim>& phase : parts.instants()) {
      const auto x = in_space(parts.pairs, phase.places, parts.mesh.nodes);
      for (const MortarPair<dim>& pair : parts.pairs)
        most = std::max(most, -travel_to_touch<dim>(pair, pair.approach, x));
    }
    return most;
  }
  return std::max(most, overlap_at_rest(contact_nodes_of(parts), parts.interface.partner));
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

}  // namespace

template <int dim>
double overlap_at_rest(const std::vector<ContactPatch<dim>>& nodes, const CounterBody<dim>& other) {
  PartnerMotion<> q = other.given(0, 0);
  q.setZero();
  double deepest = 0;
  for (const ContactPatch<dim>& patch : nodes)
    deepest = std::max(deepest, -other.unchecked_distance(patch.initial_position, q, 0).gap);
  return deepest;
}

template <int dim>
Pressing pressing_of(const AssemblyParts<dim>& parts, double duration) {
  const Interface<dim>& interface = parts.interface;
  constexpr double across = 0.1;
  double most_load = 0;
  for (const Phase<dim>& phase : parts.instants()) most_load = std::max(most_load, phase.load);
  double force = interface.force ? *interface.force / interface.partner.guides.front().share
                                 : most_load * load_along_approach(parts);
  Pressing press{.overlap = given_overlap(parts)};
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    if (const double moved = springs.displacement.cwiseAbs().maxCoeff() * springs.history.largest();
        moved > press.overlap) {
      press.overlap = moved;
      press.springs = force_of_springs(parts);
    }
  if (const double levers = most_load * load_on_levers(parts); force < across * levers)
    force = levers;
  press.force = force;
  press.impulse = force * interface.history.integral(duration);
  return press;
}

namespace {

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

/// The initial position of a node of a surface, for a law that is not defined everywhere.
template <int dim>
std::array<double, 3> node_of(const Surface<dim>& surface, const AssemblyParts<dim>& parts) {
  std::array<double, 3> place{};
  if (surface.facets.empty()) return place;
  const int node = surface.facets[surface.facets.size() / 2].front();
  std::ranges::copy(parts.mesh.nodes[static_cast<std::size_t>(node)], place.begin());
  return place;
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
      std::max(start.depth, start.force / (modulus * width_of(start.area, solid)));
  const auto circumstances = [&](const Surface<dim>& surface) {
    return WearCircumstances{.pressure = start.force / start.area,
                             .friction = parts.interface.friction,
                             .speed = parts.nominal_speed(),
                             .duration = duration,
                             .initial = {node_of(surface, parts)}};
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
  // Where laws read the depth, it is that by which each surface has receded.
  for (std::size_t s = 0; s < by_surface.size(); ++s) {
    const Surface<dim>& surface = parts.interface.surfaces[s];
    const double nominal = surface.track ? track * by_surface[s] / surface.track->path / fresh.track
                                         : local * by_surface[s] / fresh.local;
    if (by_surface[s] > 0 && nominal > 0)
      by_surface[s] *= depth_by_law(surface.wear, circumstances(surface), nominal) / nominal;
  }
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

template double overlap_at_rest(const std::vector<ContactPatch<2>>&, const CounterBody<2>&);
template double overlap_at_rest(const std::vector<ContactPatch<3>>&, const CounterBody<3>&);
template Pressing pressing_of(const AssemblyParts<2>&, double);
template Pressing pressing_of(const AssemblyParts<3>&, double);
template Magnitudes magnitudes_of(const AssemblyParts<2>&, double);
template Magnitudes magnitudes_of(const AssemblyParts<3>&, double);

}  // namespace gnomon
