#include "magnitudes.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/model/wear_scene.hpp>
#include <limits>
#include <numeric>

namespace gnomon::part {

GapProfile::GapProfile(std::vector<double> gaps, std::vector<double> areas) {
  std::vector<std::size_t> order(gaps.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return gaps[a] < gaps[b]; });
  for (std::size_t k : order) {
    gap_.push_back(gaps[k] - gaps[order.front()]);
    area_.push_back(areas[k]);
  }
}

double GapProfile::area(double depth) const {
  double sum = 0;
  for (std::size_t k = 0; k < gap_.size() && gap_[k] <= depth; ++k) sum += area_[k];
  return sum;
}

double GapProfile::count(double depth) const {
  return static_cast<double>(std::upper_bound(gap_.begin(), gap_.end(), depth) - gap_.begin());
}

double GapProfile::volume(double depth) const {
  double sum = 0;
  for (std::size_t k = 0; k < gap_.size() && gap_[k] < depth; ++k)
    sum += area_[k] * (depth - gap_[k]);
  return sum;
}

/// Volume is linear in the depth between one gap and the next.
double GapProfile::depth_of(double volume) const {
  double area = 0, moment = 0;
  for (std::size_t k = 0; k < gap_.size(); ++k) {
    area += area_[k];
    moment += area_[k] * gap_[k];
    const double depth = (volume + moment) / area;
    if (k + 1 == gap_.size() || depth <= gap_[k + 1]) return depth;
  }
  return 0;
}

namespace {

/// How far the bodies come together, on springs of stiffness E* by the width of the contact.
struct Indentation {
  double depth, area, force;
};

/// `solid`: areas are areas; else lengths, per unit of thickness.
double width_of(double area, bool solid) {
  return solid ? std::sqrt(area) : area;
}

Indentation by_force(const GapProfile& gaps, double force, double modulus, bool solid) {
  Indentation at{0, gaps.area(0), force};
  for (int k = 0; k < 30; ++k) {  // the width follows the depth
    at.depth = gaps.depth_of(force * width_of(at.area, solid) / modulus);
    at.area = std::max(gaps.area(at.depth), gaps.area(0));
  }
  return at;
}

Indentation by_overlap(const GapProfile& gaps, double depth, double modulus, bool solid) {
  const double area = std::max(gaps.area(depth), gaps.area(0));
  return {depth, area, modulus / width_of(area, solid) * gaps.volume(depth)};
}

/// The travel of a phase's counter-body to each contact node; under a force from where it touches
/// first, which is a different place in each phase (the lift of a cam).
template <int dim>
std::vector<double> travels(const Phase<dim>& phase, const WornBody<dim>& body) {
  std::vector<double> result;
  double first = std::numeric_limits<double>::infinity();
  for (const auto& patch : body.contact_nodes) {
    result.push_back(phase.counter_body.travel_to(body.mesh.nodes[patch.node]));
    first = std::min(first, result.back());
  }
  if (phase.force && std::isfinite(first))
    for (double& travel : result) travel -= first;
  return result;
}

/// The least of all phases.
template <int dim>
GapProfile gaps_of(const WornBody<dim>& body) {
  std::vector<double> least(body.contact_nodes.size(), std::numeric_limits<double>::infinity());
  for (const Phase<dim>& phase : body.phases()) {
    const std::vector<double> travel = travels(phase, body);
    for (std::size_t c = 0; c < least.size(); ++c) least[c] = std::min(least[c], travel[c]);
  }
  std::vector<double> gaps, areas;
  for (std::size_t c = 0; c < least.size(); ++c) {
    if (!std::isfinite(least[c])) continue;
    gaps.push_back(least[c]);
    areas.push_back(body.contact_nodes[c].initial_area);
  }
  return {gaps, areas};
}

}  // namespace

template <int dim>
Magnitudes find_magnitudes(const Scene& scene, double force, double overlap, double impulse,
                           const WornBody<dim>& body) {
  const double young = scene.real("body.young_modulus"), nu = scene.real("body.poisson_ratio");
  const double modulus = young / (1 - nu * nu);
  const GapProfile gaps = gaps_of(body);
  const bool solid = dim == 3 || body.element.section == Section::meridian;
  const Indentation start =
      force > 0 ? by_force(gaps, force, modulus, solid) : by_overlap(gaps, overlap, modulus, solid);
  Magnitudes result;
  Scales& scales = result.scales;
  scales.duration = scene.real("time.end");
  scales.force = start.force;
  scales.displacement =
      std::max(start.depth, start.force / (modulus * width_of(start.area, solid)));
  const double pressure = start.force / start.area;
  const double k_v =
      wear_by_pressure(scene, body.contact.wear, {pressure, scene.real("friction.coefficient")});
  // Held bodies wear until they no longer overlap.
  const double worn = force > 0
                          ? k_v * impulse
                          : std::min(k_v * start.force * scales.duration, gaps.volume(overlap));
  result.deepest = worn > 0 ? gaps.depth_of(worn) : 0;
  const double worn_area = std::max(gaps.area(result.deepest), start.area);
  scales.stress = start.force / worn_area;
  scales.wear_depth = worn > 0 ? worn / worn_area : scales.displacement;
  double area = 0, count = 0;
  for (const auto& patch : body.contact_nodes) area += patch.initial_area, ++count;
  result.facet = width_of(area / count, solid);
  result.contact_nodes = std::max(gaps.count(start.depth), gaps.count(0));
  scales.auxiliary_force =
      scene.real("shape.young_modulus") * scales.wear_depth * (dim == 2 ? 1 : result.facet);
  return result;
}

template Magnitudes find_magnitudes(const Scene&, double, double, double, const WornBody<2>&);
template Magnitudes find_magnitudes(const Scene&, double, double, double, const WornBody<3>&);

}  // namespace gnomon::part
