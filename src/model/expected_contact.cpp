#include "model/expected_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/bring_together.hpp"

namespace gnomon {

namespace {

/// Keeps the lesser of the gap and what was found before.
void keep_least(int node, double gap, std::map<int, double>& least) {
  if (!std::isfinite(gap)) return;
  const auto at = least.try_emplace(node, gap).first;
  at->second = std::min(at->second, gap);
}

/// The travel of a phase's counter-body to each contact node; under a force from where it touches
/// first, which is a different place in each phase (the lift of a cam).
template <int dim>
std::vector<double> travels(const Phase<dim>& phase, const Mesh<dim>& mesh,
                            const std::vector<ContactPatch<dim>>& patches) {
  std::vector<double> result;
  double first = std::numeric_limits<double>::infinity();
  for (const auto& patch : patches) {
    result.push_back(phase.counter_body.travel_to(mesh.nodes[patch.node], patch.initial_normal));
    first = std::min(first, result.back());
  }
  if (phase.force && std::isfinite(first))
    for (double& travel : result) travel -= first;
  return result;
}

}  // namespace

template <int dim>
std::map<int, double> gaps_over_cycle(const AssemblyParts<dim>& parts, bool masters) {
  std::map<int, double> least;
  const std::vector<ContactPatch<dim>> patches =
      parts.pairs.empty() ? contact_nodes_of(parts) : std::vector<ContactPatch<dim>>{};
  for (const Phase<dim>& phase : parts.instants()) {
    const std::vector<double> travel = travels(phase, parts.mesh, patches);
    for (std::size_t c = 0; c < patches.size(); ++c) keep_least(patches[c].node, travel[c], least);
    if (parts.pairs.empty()) continue;
    const auto x = in_space(parts.pairs, phase.places, parts.mesh.nodes);
    for (const MortarPair<dim>& pair : parts.pairs) {
      const double first = travel_to_touch<dim>(pair, pair.approach, x);
      for (int side = 0; side <= int(masters); ++side)
        for (const auto& [node, along] : travels_of_side<dim>(pair, side, x))
          keep_least(node, along - first, least);
    }
  }
  return least;
}

template <int dim>
std::vector<Ball<dim>> expected_contact(const AssemblyParts<dim>& parts,
                                        const Magnitudes& expected) {
  constexpr double margin = 1.2;
  const std::map<int, double> gaps = gaps_over_cycle(parts, true);
  std::map<int, Ball<dim>> balls;  // by node
  double first = std::numeric_limits<double>::infinity();
  for (const auto& [node, gap] : gaps) first = std::min(first, gap);
  const double depth = margin * (expected.deepest + expected.scales.displacement);
  for (const auto& [node, gap] : gaps)
    if (gap - first <= depth)
      balls.emplace(node, Ball<dim>{parts.mesh.nodes[static_cast<std::size_t>(node)]});
  const auto measure = [&](const std::vector<typename Mesh<dim>::Facet>& facets) {
    for (const auto& facet : facets)
      for (const int one : facet)
        if (const auto ball = balls.find(one); ball != balls.end())
          for (const int other : facet)
            ball->second.radius = std::max(
                ball->second.radius,
                (parts.mesh.nodes[static_cast<std::size_t>(other)] - ball->second.centre).norm());
  };
  for (const Surface<dim>& surface : parts.interface.surfaces) measure(surface.facets);
  for (const MortarPair<dim>& pair : parts.pairs) measure(pair.slave), measure(pair.master);
  std::vector<Ball<dim>> result;
  for (const auto& [node, ball] : balls) result.push_back(ball);
  return result;
}

template std::map<int, double> gaps_over_cycle(const AssemblyParts<2>&, bool);
template std::map<int, double> gaps_over_cycle(const AssemblyParts<3>&, bool);
template std::vector<Ball<2>> expected_contact(const AssemblyParts<2>&, const Magnitudes&);
template std::vector<Ball<3>> expected_contact(const AssemblyParts<3>&, const Magnitudes&);

}  // namespace gnomon
