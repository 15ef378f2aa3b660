#include "part/round_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/facet_table.hpp"
#include "part/facing_facets.hpp"
#include "part/groups.hpp"

namespace gnomon::part {

namespace {

/// How far the round surface that some facets stand for lies outside of them, in the mean [length].
template <int dim>
double mean_outside(const ImportedBody<dim>& part, const Facets<dim>& facets) {
  double area = 0, volume = 0;
  for (const auto& patch : contact_patches<dim>(part.mesh, facets, {}, Section::plane))
    area += patch.initial_area;
  const std::set<int> nodes = nodes_of_facets(facets);
  for (const RoundFacet& facet : part.round)
    if (std::ranges::all_of(facet.nodes, [&](int node) { return nodes.contains(node); }))
      volume += facet.area * facet.outside;
  return volume / area;
}

/// Or nothing. `expected`: how far all that presses is expected to press the bodies into each
/// other, which counts where they do not fit tightly [length].
template <int dim>
std::string remark_on_round_fit(const ImportedBody<dim>& part, const MortarPair<dim>& pair,
                                const std::vector<Vector<dim>>& x, Section section,
                                double expected) {
  constexpr double seen = 0.05, all = 0.95;
  if (part.round.empty()) return "";
  const Cover cover = cover_of(pair, x, section);
  const double overlap = -cover.volume / cover.area;
  if (!(overlap > 0)) return "";
  const double by_facets = -mean_outside(part, pair.slave) - mean_outside(part, pair.master),
               round = overlap - by_facets;
  const bool is_tight =
      round > seen * expected || (pair.interference > 0 && round > seen * pair.interference);
  if (std::abs(by_facets) <= seen * (is_tight ? round : expected)) return "";
  const std::string effect =
      by_facets > all * overlap
          ? "the pressure that this causes means nothing"
          : fmt::format("the pressure that this causes is about {:.2g} times that of round bodies",
                        overlap / round);
  return fmt::format(
      "\"{}\" and \"{}\" overlap by {:.3g} mm in the mean, their round surfaces by {:.3g} mm, "
      "since facets of different length are chords of these: {}; expected nodes that match, or a "
      "finer "
      "mesh (mesh.factor, mesh.split)",
      pair.bodies[0], pair.bodies[1], overlap, std::max(0.0, round), effect);
}

}  // namespace

template <int dim>
void tell_round_fits(const ImportedBody<dim>& part, const std::vector<std::vector<Vector<dim>>>& x,
                     AssemblyParts<dim>& parts) {
  for (std::size_t k = 0; k < parts.pairs.size(); ++k)
    if (std::string fit = remark_on_round_fit(part, parts.pairs[k], x[k], parts.section(),
                                              parts.scales.displacement);
        !fit.empty())
      parts.remarks.push_back(std::move(fit));
}

template void tell_round_fits(const ImportedBody<2>&, const std::vector<std::vector<Vector<2>>>&,
                              AssemblyParts<2>&);
template void tell_round_fits(const ImportedBody<3>&, const std::vector<std::vector<Vector<3>>>&,
                              AssemblyParts<3>&);

}  // namespace gnomon::part
